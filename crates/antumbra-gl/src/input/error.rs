//! What can go wrong between a host, antumbra and a driver.

use super::{FrameFault, LightFault, Refusal};
use std::fmt;

/// Why a renderer could not be made or a frame could not be shadowed. The host's OpenGL state is
/// as it was whenever one of these is returned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The loader of [`crate::Renderer::from_loader`] does not find a function that every context has, or it has no
    /// answer: because no context is current, or because the loader looks among extensions alone.
    #[error(
        "the loader finds no working OpenGL function {name}; is a context current on this thread, and does the loader know \
         more than extensions?"
    )]
    NoContext {
        /// The function.
        name: &'static str,
    },
    /// The context is older than OpenGL 3.3 or OpenGL ES 3.0.
    #[error("OpenGL 3.3 or OpenGL ES 3.0 is needed, the context is {found}; ask for a newer one")]
    TooOld {
        /// The version string of the context.
        found: String,
    },
    /// A shader did not compile or link: a bug of antumbra or of the driver.
    #[error("shader {name}: {log}")]
    Shader {
        /// The program.
        name: &'static str,
        /// What the driver says.
        log: String,
    },
    /// The driver refused an object or a framebuffer, most often for lack of memory.
    #[error("the driver could not make {0}")]
    Resource(Resource),
    /// The frame asks for what this context cannot do.
    #[error("{0}")]
    Unsupported(Unsupported),
    /// A texture of the surface is attached to the framebuffer that is to be drawn to: reading
    /// and writing one image in one draw is undefined in OpenGL.
    #[error(
        "the surface's {image} texture is attached to the framebuffer that is drawn to; take a framebuffer with the \
         colour alone, or let the renderer copy the depth (`Surface::copied`)"
    )]
    SurfaceAttached {
        /// Which texture.
        image: Image,
    },
    /// The technique cannot do what the frame asks for.
    #[error("the technique {technique} {}", .refusal.reason)]
    Refused {
        /// Its name.
        technique: &'static str,
        /// What it cannot do.
        refusal: Refusal,
    },
    /// A light's numbers make no sense.
    #[error("bad light {index}: {fault}")]
    BadLight {
        /// Its index in [`crate::Frame::lights`].
        index: usize,
        /// What is wrong with it.
        fault: LightFault,
    },
    /// The frame is not a frame: its numbers or sizes make no sense.
    #[error("bad frame: {0}")]
    BadFrame(FrameFault),
}

/// One of a [`crate::Surface`]'s textures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Image {
    /// The depth.
    Depth,
    /// The normals.
    Normals,
    /// The ids.
    Ids,
}

impl fmt::Display for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Depth => "depth",
            Self::Normals => "normals",
            Self::Ids => "ids",
        })
    }
}

/// An OpenGL object of the renderer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Resource {
    /// A shader program.
    #[error("a program for {name}")]
    Program {
        /// The program.
        name: &'static str,
    },
    /// A texture that is drawn to, with its framebuffer.
    #[error("a {width}x{height} render target of {bits} bits a channel with {samples} samples")]
    Target {
        /// Pixels across.
        width: i32,
        /// Pixels down.
        height: i32,
        /// Of each of four channels.
        bits: u32,
        /// Samples a pixel.
        samples: u32,
    },
    /// A stencil buffer.
    #[error("a {width}x{height} stencil buffer with {samples} samples")]
    Stencil {
        /// Pixels across.
        width: i32,
        /// Pixels down.
        height: i32,
        /// Samples a pixel.
        samples: u32,
    },
    /// A copy of the host's depth.
    #[error("a {width}x{height} copy of the depth buffer with {samples} samples")]
    DepthCopy {
        /// Pixels across.
        width: i32,
        /// Pixels down.
        height: i32,
        /// Samples a pixel.
        samples: u32,
    },
    /// A shadow map.
    #[error("a {width}x{height} shadow map")]
    ShadowMap {
        /// Texels across.
        width: u32,
        /// Texels down.
        height: u32,
    },
    /// The buffers of a mesh.
    #[error("buffers for a mesh of {triangles} triangles")]
    Mesh {
        /// How many.
        triangles: usize,
    },
    /// A vertex array, or a buffer for one.
    #[error("a vertex array with its buffer")]
    Vertices,
    /// A texture of numbers.
    #[error("a data texture")]
    Data,
}

/// What a frame asks for and a context cannot do: a sentence that says what would make it possible.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Unsupported {
    /// A multisampled surface.
    #[error(
        "a multisampled surface needs OpenGL 4.0 or GL_ARB_sample_shading; resolve colour and depth first"
    )]
    Multisampling,
    /// A surface of this many samples.
    #[error(
        "a surface of {samples} samples needs a driver that has textures of as many; this one has {most}"
    )]
    Samples {
        /// Of the surface.
        samples: u32,
        /// The driver's.
        most: u32,
    },
    /// An overlay of more lights than one batch has.
    #[error(
        "an overlay of more than 8 lights needs floating-point render targets that blend \
         (EXT_color_buffer_float, EXT_float_blend), or masks"
    )]
    ManyLights,
    /// Lights with an area as points.
    #[error(
        "sampled lights need floating-point render targets that blend (EXT_color_buffer_float, EXT_float_blend)"
    )]
    SampledLights,
    /// Lights with an area, painted as collections of points.
    #[error(
        "painting lights with an area needs floating-point render targets that blend (EXT_color_buffer_float, \
         EXT_float_blend)"
    )]
    PaintedAreas,
    /// More pairs of light and occluder than a texture holds.
    #[error("this many occluders need larger textures")]
    ManyOccluders,
    /// A mesh too large for one draw.
    #[error("a mesh of this many triangles needs to be several smaller meshes")]
    LargeMesh,
    /// Shadow volumes too large for one buffer.
    #[error("shadow volumes of this many polygons need coarser meshes, or fewer")]
    ManyPolygons,
    /// Shadow maps too large for a texture.
    #[error(
        "shadow maps of this size need a smaller option `size`, a third of the driver's largest texture for point \
         lights"
    )]
    LargeMaps,
    /// Clip space upside down.
    #[error(
        "shadows are drawn with the origin in the lower left; call glClipControl(GL_LOWER_LEFT, ..) before"
    )]
    UpperLeft,
    /// The depth of a framebuffer that has none.
    #[error("shadows need a depth buffer, and the framebuffer has none")]
    NoDepth,
    /// The depth of this framebuffer cannot be copied.
    #[error(
        "the driver does not copy this framebuffer's depth; draw to a depth texture (`Surface::from_depth`), or take \
         another depth format"
    )]
    DepthCopy,
    /// A depth texture that is a layer of an array, a face of a cube or a level of a mipmap.
    #[error(
        "a depth texture needs to be plain, level 0 of a TEXTURE_2D or TEXTURE_2D_MULTISAMPLE, to be read where it is; \
         let the renderer copy it (`Surface::copied`)"
    )]
    DepthLayer,
    /// The depth of a framebuffer that is not a texture, where a texture was asked for.
    #[error(
        "the framebuffer's depth needs to be a texture to be read where it is; let the renderer copy it (`Surface::copied`)"
    )]
    DepthNoTexture,
}
