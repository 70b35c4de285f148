//! The stage as a viewer uses it: among other users of the context, and frame after frame.

mod common;

use antumbra::Component;
use antumbra::glam::DVec3;
use antumbra::{Soft, Technique};
use antumbra_host::{
    Api, Buffers, ColorFormat, HostError, Picture, RenderOptions, Rendered, Setting, Stage, TestContext,
    objection,
};
use antumbra_scene::Scene;
use glow::HasContext;

const WIDTH: u32 = 160;
const HEIGHT: u32 = 96;
const ASPECT: f64 = WIDTH as f64 / HEIGHT as f64;

/// A scene with every kind of primitive the stage draws, under `light`.
fn scene(light: &str) -> Scene {
    let text = format!(
        r#"
        ambient = [0.05, 0.05, 0.05]
        camera = {{ eye = [0.5, 3.0, 6.0], target = [0.0, 0.5, 0.0] }}
        [[light]]
        name = "lamp"
        intensity = 60
        position = [1.5, 4.0, 1.0]
        {light}
        motion = {{ type = "orbit", center = [0, 4, 0], axis = [0, 1, 0], period = 8 }}
        [[object]]
        name = "floor"
        shape = {{ type = "plane" }}
        [[object]]
        name = "ball"
        shape = {{ type = "sphere", radius = 0.5 }}
        translation = [-1.2, 0.9, 0.0]
        [[object]]
        name = "rings"
        parts = [
            {{ shape = {{ type = "torus", major_radius = 0.5, minor_radius = 0.15 }}, translation = [0, 0, 0] }},
            {{ shape = {{ type = "torus", major_radius = 0.5, minor_radius = 0.15 }}, translation = [0, 0.6, 0] }},
        ]
        translation = [0.5, 0.8, 0.3]
        [[object]]
        name = "crate"
        shape = {{ type = "box", size = [0.6, 0.8, 0.5] }}
        translation = [1.6, 0.7, -0.6]
        "#
    );
    Scene::parse(&text, "stage.toml".as_ref()).expect("the scene is right")
}

fn render(stage: &mut Stage, scene: &Scene, technique: &str, msaa: u32) -> Rendered {
    let technique = Technique::parse(technique).expect("a technique");
    let options = RenderOptions {
        time: 0.0,
        width: WIDTH,
        height: HEIGHT,
        msaa,
        visibility: true,
        shadows: true,
        technique,
        soft: Soft::Native,
    };
    stage.render(scene, &options).unwrap_or_else(|error| panic!("{technique:?}: {error}"))
}

/// Sets everything that a picture could depend on to something else than the stage wants.
fn spoil(gl: &glow::Context) {
    let desktop = !gl.version().is_embedded;
    // SAFETY: settings every context has, and fresh objects that stay bound.
    unsafe {
        gl.enable(glow::SCISSOR_TEST);
        gl.scissor(0, 0, 1, 1);
        gl.color_mask(false, true, false, false);
        gl.depth_mask(false);
        gl.depth_func(glow::NEVER);
        gl.depth_range_f32(0.4, 0.3);
        gl.enable(glow::STENCIL_TEST);
        gl.stencil_func(glow::NEVER, 1, u32::MAX);
        gl.enable(glow::BLEND);
        gl.blend_func(glow::ZERO, glow::SRC_ALPHA);
        gl.blend_equation(glow::FUNC_REVERSE_SUBTRACT);
        gl.enable(glow::CULL_FACE);
        gl.cull_face(glow::FRONT_AND_BACK);
        gl.front_face(glow::CW);
        gl.enable(glow::POLYGON_OFFSET_FILL);
        gl.polygon_offset(5.0, 5.0);
        gl.enable(glow::DITHER);
        gl.enable(glow::RASTERIZER_DISCARD);
        gl.enable(glow::SAMPLE_ALPHA_TO_COVERAGE);
        gl.enable(glow::SAMPLE_COVERAGE);
        gl.sample_coverage(0.3, true);
        gl.viewport(3, 3, 7, 7);
        if desktop {
            gl.enable(glow::COLOR_LOGIC_OP);
            gl.enable(glow::DEPTH_CLAMP);
            gl.enable(glow::FRAMEBUFFER_SRGB);
            gl.enable(glow::SAMPLE_ALPHA_TO_ONE);
            gl.enable(glow::SAMPLE_MASK);
            gl.enable(glow::PRIMITIVE_RESTART);
            gl.enable(glow::CLIP_DISTANCE0);
            gl.disable(glow::MULTISAMPLE);
            gl.polygon_mode(glow::FRONT_AND_BACK, glow::LINE);
            gl.pixel_store_i32(glow::PACK_SWAP_BYTES, 1);
        }
        for name in [glow::PACK_ROW_LENGTH, glow::UNPACK_ROW_LENGTH] {
            gl.pixel_store_i32(name, 500);
        }
        for name in [glow::PACK_SKIP_ROWS, glow::PACK_SKIP_PIXELS, glow::UNPACK_SKIP_ROWS] {
            gl.pixel_store_i32(name, 3);
        }
        gl.pixel_store_i32(glow::PACK_ALIGNMENT, 8);
        for target in [glow::PIXEL_PACK_BUFFER, glow::PIXEL_UNPACK_BUFFER, glow::UNIFORM_BUFFER] {
            let buffer = gl.create_buffer().expect("a buffer");
            gl.bind_buffer(target, Some(buffer));
            gl.buffer_data_size(target, 16, glow::STATIC_DRAW);
        }
        let sampler = gl.create_sampler().expect("a sampler");
        gl.sampler_parameter_i32(sampler, glow::TEXTURE_MIN_FILTER, glow::LINEAR_MIPMAP_LINEAR as i32);
        gl.sampler_parameter_i32(sampler, glow::TEXTURE_COMPARE_MODE, glow::COMPARE_REF_TO_TEXTURE as i32);
        let texture = gl.create_texture().expect("a texture");
        for unit in 0..8 {
            gl.active_texture(glow::TEXTURE0 + unit);
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            gl.bind_sampler(unit, Some(sampler));
        }
        let vertex_array = gl.create_vertex_array().expect("a vertex array");
        gl.bind_vertex_array(Some(vertex_array));
        gl.enable_vertex_attrib_array(5);
        gl.bind_framebuffer(glow::FRAMEBUFFER, None);
        gl.use_program(None);
        assert_eq!(gl.get_error(), glow::NO_ERROR, "the state is there to be spoilt");
    }
}

/// Whatever state others leave, before the first frame or between frames, the picture is the same.
#[test]
fn what_others_leave_in_the_context_changes_nothing() {
    let scene = scene("type = \"point\"");
    for (api, msaa) in [(Api::Gl33, 1), (Api::Gl33, 4), (Api::Gles30, 1)] {
        let Some(context) = TestContext::new(api) else { return };
        let gl = context.gl();
        let mut stage = Stage::new(gl).expect("a stage");
        let clean = render(&mut stage, &scene, "map", msaa);
        assert!(clean.image.iter().any(|c| c != &clean.image[0]), "there is something to see");
        drop(stage);
        spoil(gl);
        let mut stage = Stage::new(gl).expect("a stage");
        for round in 0..2 {
            spoil(gl);
            let spoilt = render(&mut stage, &scene, "map", msaa);
            assert_eq!(clean.image, spoilt.image, "{api:?}, {msaa} samples, round {round}: the picture");
            assert_eq!(
                clean.visibility, spoilt.visibility,
                "{api:?}, {msaa} samples, round {round}: the masks"
            );
        }
        // Between drawing and looking too.
        let plain = |stage: &mut Stage, spoilt: bool| {
            let setting = stage.setting(&scene, 0.0, ASPECT).expect("a setting");
            stage
                .draw(&setting, WIDTH, HEIGHT, msaa, ColorFormat::Rgba8, Buffers::Color)
                .expect("the setting draws");
            if spoilt {
                spoil(gl);
            }
            let picture = stage.color().expect("something was drawn");
            bytes(gl, &picture)
        };
        assert_eq!(plain(&mut stage, false), plain(&mut stage, true), "{api:?}, {msaa} samples: resolved");
    }
}

/// The bytes of a picture of 8 bits a channel.
fn bytes(gl: &glow::Context, picture: &Picture) -> Vec<u8> {
    let mut bytes = vec![0; (picture.width * picture.height * 4) as usize];
    // SAFETY: reads as many bytes as there are into memory of that size, packed without gaps.
    unsafe {
        gl.bind_buffer(glow::PIXEL_PACK_BUFFER, None);
        for name in [glow::PACK_ROW_LENGTH, glow::PACK_SKIP_ROWS, glow::PACK_SKIP_PIXELS] {
            gl.pixel_store_i32(name, 0);
        }
        gl.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(picture.framebuffer));
        gl.finish();
        let (width, height) = (picture.width as i32, picture.height as i32);
        let data = glow::PixelPackData::Slice(Some(&mut bytes));
        gl.read_pixels(0, 0, width, height, glow::RGBA, glow::UNSIGNED_BYTE, data);
    }
    bytes
}

/// The colour can be had as a texture, with what was added to it, and the surface too.
#[test]
fn what_was_drawn_is_there_to_be_shown() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let gl = context.gl();
    let mut stage = Stage::new(gl).expect("a stage");
    stage.set_technique(Technique::parse("map").expect("a technique")).expect("the driver can");
    assert!(stage.color().is_none() && stage.surface().is_none(), "nothing was drawn");
    let scene = scene("type = \"point\"");
    let setting = stage.setting(&scene, 0.0, ASPECT).expect("a setting");
    for samples in [1, 4] {
        stage
            .draw(&setting, WIDTH, HEIGHT, samples, ColorFormat::Rgba8, Buffers::All)
            .expect("the setting draws");
        let plain = stage.color().expect("it was drawn");
        assert_eq!((plain.width, plain.height), (WIDTH, HEIGHT), "the picture's size");
        let before = bytes(gl, &plain);
        stage.add_shadows(&setting).expect("the technique can");
        let shadowed = stage.color().expect("it was drawn");
        assert_eq!(plain, shadowed, "the same texture");
        let after = bytes(gl, &shadowed);
        let darker = before.iter().zip(&after).filter(|(before, after)| after < before).count();
        assert!(darker > 500, "{samples} samples: {darker} bytes are darker with shadows");
        let surface = stage.surface().expect("it was drawn");
        assert_eq!(surface.samples, samples, "the surface's samples");
        let antumbra::Depth::Texture(depth) = surface.depth else { panic!("a texture: {surface:?}") };
        // SAFETY: asks whether names are of textures.
        let textures = unsafe { gl.is_texture(shadowed.texture) && gl.is_texture(depth.glow()) };
        assert!(textures, "{shadowed:?}, {surface:?} are textures");
    }
    // SAFETY: asks for the error flag.
    assert_eq!(unsafe { gl.get_error() }, glow::NO_ERROR, "nothing went wrong");
}

fn mesh_ids(setting: &Setting) -> Vec<u64> {
    setting.described.meshes.iter().map(|occluder| occluder.mesh.id()).collect()
}

/// A mesh is made once for all moments that show its shape, and forgotten when no setting has it.
#[test]
fn meshes_are_kept_while_they_are_used() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let scene = scene("type = \"point\"");
    let mut setting = |scene: &Scene, time| stage.setting(scene, time, ASPECT).expect("a setting");
    let first = setting(&scene, 0.0);
    let ids = mesh_ids(&first);
    assert_eq!(ids.len(), 3, "two tori and a box");
    assert_eq!(ids[0], ids[1], "equal shapes are one mesh");
    assert_ne!(ids[0], ids[2], "others are not");
    drop(first);
    let next = setting(&scene.clone(), 1.0);
    assert_eq!(mesh_ids(&next), ids, "the next moment has the same meshes");
    // A shape that changes is another mesh, and the rest stays.
    let mut other = scene.clone();
    other.objects[3].parts[0].shape = antumbra_scene::Shape::Box { size: DVec3::ONE };
    let other = setting(&other, 1.0);
    assert_eq!(mesh_ids(&other)[..2], ids[..2], "the rings are as they were");
    assert_ne!(mesh_ids(&other)[2], ids[2], "the box is not");
    assert_eq!(mesh_ids(&setting(&scene, 2.0)), ids, "`next` still holds the first box");
    drop(next);
    let empty = Scene { objects: Vec::new(), ..scene.clone() };
    assert!(mesh_ids(&setting(&empty, 0.0)).is_empty(), "nothing to make");
    assert_ne!(mesh_ids(&setting(&scene, 0.0))[2], ids[2], "nobody had the box any more");
    assert_eq!(mesh_ids(&other)[..2], ids[..2], "a setting keeps what it has");
}

/// A setting says of itself what a technique cannot do of it, in the same words as from the scene.
#[test]
fn settings_know_what_techniques_refuse() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let mut refused = 0;
    for light in ["type = \"point\"", "type = \"sphere\"\nradius = 0.4"] {
        let scene = scene(light);
        let mut setting = stage.setting(&scene, 0.0, ASPECT).expect("a setting");
        assert_eq!(setting.moment(), &scene.moment(0.0), "the moment it was made for");
        assert_eq!(setting.camera().view, scene.camera.view(), "the scene's camera");
        assert_eq!(setting.camera().projection.w_axis.z, setting.near(), "depth is near over distance");
        for technique in Technique::all() {
            let words = |error: Option<HostError>| error.map(|error| error.to_string());
            let expected = words(objection(&scene, &scene.moment(0.0), &technique, Soft::Native));
            refused += usize::from(expected.is_some());
            assert_eq!(words(setting.objection(&technique, Soft::Native)), expected, "{technique:?}");
        }
        // Whoever edits what is described may leave ids that no object has.
        setting.described.meshes.iter_mut().for_each(|mesh| mesh.id = u32::MAX);
        let composite = Technique::parse("composite").expect("a technique");
        let words = setting.objection(&composite, Soft::Native).expect("it has no tori").to_string();
        assert!(words.starts_with("an object: "), "{words}");
    }
    assert!(refused > 0, "some technique refuses something");
    for aspect in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = stage.setting(&scene("type = \"point\""), 0.0, aspect);
        assert!(matches!(refused, Err(HostError::BadRequest(_))), "{aspect} is no aspect");
    }
}

/// Components put somewhere by hand reach the technique.
#[test]
fn components_move_the_penumbra() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let gl = context.gl();
    let mut stage = Stage::new(gl).expect("a stage");
    stage.set_technique(Technique::parse("composite").expect("a technique")).expect("the driver can");
    let mut scene = scene("type = \"sphere\"\nradius = 0.4");
    scene.objects.truncate(2);
    let mut draw = |components: Vec<Component>| {
        let mut setting = stage.setting(&scene, 0.0, ASPECT).expect("a setting");
        assert!(setting.components.is_empty(), "on the rim to begin with");
        setting.components = components;
        stage.draw(&setting, WIDTH, HEIGHT, 1, ColorFormat::Rgba8, Buffers::All).expect("the setting draws");
        stage.add_shadows(&setting).expect("the technique can");
        bytes(gl, &stage.color().expect("it was drawn"))
    };
    let rim = draw(Vec::new());
    let moved = draw(vec![Component::new(0, DVec3::new(-1.5, 0.0, 0.5))]);
    assert!(rim.iter().zip(&moved).filter(|(a, b)| a != b).count() > 200, "the shadow is elsewhere");
    assert_eq!(draw(Vec::new()), rim, "and back");
}
