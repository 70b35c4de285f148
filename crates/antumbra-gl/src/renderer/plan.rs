//! What a frame needs, decided once.

use crate::gl::{Caps, Drawing, Needs, TargetFormat, Variant};
use crate::input::{Area, Error, Frame, HostState, Light, Soft, Surface, Unsupported};
use crate::masks::{BATCH_LIGHTS, Sampling};
use crate::screen::View;
use crate::technique::Technique;

/// What a frame is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// The host's picture.
    Overlay,
    /// The host's own lighting.
    Masks,
    /// A look at one light's map.
    Map,
}

/// How a renderer finds shadows, and in what context.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    pub(super) technique: Technique,
    pub(super) soft: Soft,
    pub(super) caps: Caps,
}

/// Everything about a frame that is decided before anything is drawn.
pub(super) struct FramePlan<'a> {
    pub(super) frame: Frame<'a>,
    pub(super) view: View,
    /// Whether the technique paints over the host's pixels; it then sees the lights as they are.
    pub(super) paints: bool,
    /// Which points stand for each light with an area; `None` if the technique draws areas itself, or there are none.
    pub(super) sampling: Option<Sampling>,
    pub(super) programs: Programs,
    /// Of the masks.
    pub(super) format: TargetFormat,
}

impl<'a> FramePlan<'a> {
    /// Checks the frame and plans it. `centers` is memory that is kept.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`], [`Error::Refused`], [`Error::Unsupported`].
    pub(super) fn new(
        frame: &Frame<'a>,
        purpose: Purpose,
        manner: &Manner,
        centers: &mut Vec<Light>,
    ) -> Result<Self, Error> {
        let Manner { technique, soft, caps } = manner;
        let view = View::new(frame, caps.max_texture_size)?;
        if let Some(refusal) = technique.refusal_in(*soft, &frame.scenery(), centers) {
            return Err(Error::Refused { technique: technique.name(), refusal });
        }
        check_surface(&frame.surface, caps)?;
        let paints = purpose == Purpose::Overlay && technique.paints();
        let sampling = sampling(manner, frame.lights, paints);
        if sampling.is_some() && !caps.float_targets() {
            return Err(Error::Unsupported(Unsupported::SampledLights));
        }
        let many = frame.lights.len() > BATCH_LIGHTS;
        if purpose == Purpose::Overlay && !paints && many && !caps.float_targets() {
            return Err(Error::Unsupported(Unsupported::ManyLights));
        }
        let has_areas = frame.lights.iter().any(|light| light.area != Area::None);
        Ok(Self {
            frame: *frame,
            view,
            paints,
            sampling,
            programs: Programs::new(manner, &frame.surface, frame.lights, sampling.is_some()),
            format: if has_areas && caps.half_targets() {
                TargetFormat::Rgba16F
            } else {
                TargetFormat::Rgba8
            },
        })
    }
}

impl FramePlan<'_> {
    /// The frame as it is.
    pub(super) fn drawing<'a>(
        &'a self,
        gl: &'a glow::Context,
        caps: &'a Caps,
        host: HostState,
    ) -> Drawing<'a> {
        Drawing { gl, caps, host, frame: self.frame, view: &self.view, needs: self.programs.overlay }
    }
}

/// The programs that a frame is drawn with.
pub(super) struct Programs {
    pub(super) variant: Variant,
    /// Of the technique.
    pub(super) technique: Needs,
    /// Of the overlay.
    pub(super) overlay: Needs,
    /// Whether lights are sampled.
    pub(super) sampled: bool,
}

impl Programs {
    pub(super) fn new(manner: &Manner, surface: &Surface, lights: &[Light], sampled: bool) -> Self {
        let needs = Needs::of(lights);
        let seen = Needs { exact: manner.technique.is_exact(), ..needs };
        Self {
            variant: Variant::of(surface),
            technique: if sampled { Needs::default() } else { seen },
            overlay: needs,
            sampled,
        }
    }
}

/// Whether the context can read such a surface.
///
/// # Errors
/// [`Error::Unsupported`].
pub(super) fn check_surface(surface: &Surface, caps: &Caps) -> Result<(), Error> {
    let (samples, most) = (surface.samples, caps.max_samples);
    if samples > 1 && !caps.sample_shading() {
        return Err(Error::Unsupported(Unsupported::Multisampling));
    }
    if samples > most {
        return Err(Error::Unsupported(Unsupported::Samples { samples, most }));
    }
    Ok(())
}

/// See [`FramePlan::sampling`].
pub(super) fn sampling(manner: &Manner, lights: &[Light], paints: bool) -> Option<Sampling> {
    if paints || lights.iter().all(|light| light.area == Area::None) {
        return None;
    }
    match manner.soft {
        Soft::Samples { count, pattern } => Some(Sampling::Spread(count, pattern)),
        // What it paints is no visibility: masks are the average over the same components.
        Soft::Native => manner.technique.components().map(Sampling::Components),
    }
}
