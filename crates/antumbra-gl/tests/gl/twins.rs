//! The shaders' functions are their Rust twins, in float32.

use crate::context::{Gl, in_each_api};
use crate::shot::{read_texture, texture};
use antumbra_gl::{Light, ShaderLight};
use antumbra_math::blocking::{
    Blocker, Blockers, Footprint, PolygonBlocker, half_plane_coverage, polygon_coverage, screen_footprint,
};
use antumbra_math::composite::{PartShape, PlacedPart, part_coverage};
use antumbra_math::{Cone, Disc, PlaneFrame, Rectangle, Shape, Sphere, Triangle};
use glam::{DMat4, DVec2, DVec3, Vec3, Vec4};
use glow::HasContext;

const COVERAGE: &str = include_str!("../../src/shaders/coverage.glsl");
const SURFACE: &str = include_str!("../../src/shaders/surface.glsl");
pub(crate) const AREA: &str = include_str!("../../src/shaders/area.glsl");
pub(crate) const LIGHTS: &str = include_str!("../../src/shaders/lights.glsl");
const SPHERE: &str = include_str!("../../src/shaders/analytic/sphere.glsl");
const DISC: &str = include_str!("../../src/shaders/analytic/disc.glsl");
const POLYGON: &str = include_str!("../../src/shaders/analytic/polygon.glsl");
const PART: &str = include_str!("../../src/shaders/composite/part.glsl");

/// Calls side by side in a row of the target.
const ROW: usize = 64;

/// Runs `body`, which reads `INPUT(0)` to `INPUT(K - 1)` and writes `o_out`, on each of `inputs`.
/// `None` where float targets are missing.
pub(crate) fn on_gpu<const K: usize>(
    gl: &Gl,
    parts: &[&str],
    body: &str,
    inputs: &[[Vec4; K]],
) -> Option<Vec<Vec4>> {
    let context = &gl.gl;
    if !gl.is_desktop()
        && gl.version() < (3, 2)
        && !context.supported_extensions().contains("GL_EXT_color_buffer_float")
    {
        eprintln!("SKIPPED: no floating-point targets");
        return None;
    }
    let header = if gl.is_desktop() {
        "#version 330 core\n"
    } else {
        include_str!("../../src/shaders/header_300es.glsl")
    };
    let prelude = format!(
        "uniform highp sampler2D u_in;\n#define K {K}\n\
         #define INPUT(k) texelFetch(u_in, ivec2(int(gl_FragCoord.x) * K + (k), int(gl_FragCoord.y)), 0)\n\
         vec4 blocker[5];\n#define BLOCKER_DATA blocker\nlayout(location = 0) out vec4 o_out;\n"
    );
    let fragment = format!("{header}{prelude}{}\nvoid main() {{ {body} }}\n", parts.concat());
    let vertex = format!(
        "{header}void main() {{ gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }}"
    );
    let rows = inputs.len().div_ceil(ROW);
    let mut texels = inputs.to_vec();
    texels.resize(rows * ROW, [Vec4::ZERO; K]);
    let float = [glow::RGBA32F, glow::RGBA, glow::FLOAT];
    let flat: &[Vec4] = texels.as_flattened();
    let size = [ROW as i32, rows as i32];
    let input = texture(context, [size[0] * K as i32, size[1]], float, flat);
    let output = texture(context, size, float, &vec![Vec4::NAN; rows * ROW]);
    // SAFETY: objects are made, used and deleted in this context.
    unsafe {
        let program = context.create_program().expect("a program");
        for (kind, source) in [(glow::VERTEX_SHADER, &vertex), (glow::FRAGMENT_SHADER, &fragment)] {
            let shader = context.create_shader(kind).expect("a shader");
            context.shader_source(shader, source);
            context.compile_shader(shader);
            let log = context.get_shader_info_log(shader);
            assert!(context.get_shader_compile_status(shader), "{log}\n{source}");
            context.attach_shader(program, shader);
            context.delete_shader(shader);
        }
        context.link_program(program);
        assert!(context.get_program_link_status(program), "{}", context.get_program_info_log(program));
        let framebuffer = context.create_framebuffer().expect("a framebuffer");
        context.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        let attachment = glow::COLOR_ATTACHMENT0;
        context.framebuffer_texture_2d(glow::FRAMEBUFFER, attachment, glow::TEXTURE_2D, Some(output), 0);
        let vertex_array = context.create_vertex_array().expect("a vertex array");
        context.bind_vertex_array(Some(vertex_array));
        context.use_program(Some(program));
        context.bind_texture(glow::TEXTURE_2D, Some(input));
        context.uniform_1_i32(context.get_uniform_location(program, "u_in").as_ref(), 0);
        context.viewport(0, 0, size[0], size[1]);
        context.draw_arrays(glow::TRIANGLES, 0, 3);
        let mut results: Vec<Vec4> = read_texture(context, output, size);
        results.truncate(inputs.len());
        context.use_program(None);
        context.bind_vertex_array(None);
        context.delete_vertex_array(vertex_array);
        context.delete_framebuffer(framebuffer);
        context.delete_program(program);
        context.delete_texture(input);
        context.delete_texture(output);
        gl.assert_no_complaint("a twin's draw");
        Some(results)
    }
}

/// Asserts that numbers agree within `close` but for a fraction `over`. A number that is none on the
/// CPU is none, or nothing, on the GPU.
pub(crate) fn assert_equal(what: &str, gpu: &[f32], cpu: &[f32], close: f32, over: f64) {
    assert_eq!(gpu.len(), cpu.len(), "a result a call");
    let same = |g: f32, c: f32| (g - c).abs() <= close || g == c || (c.is_nan() && !(g > 0.0));
    let off: Vec<_> = gpu.iter().zip(cpu).enumerate().filter(|(_, (g, c))| !same(**g, **c)).collect();
    let between = cpu.iter().filter(|c| **c > 0.0 && **c < 1.0).count();
    eprintln!("{what}: {} of {} off, {between} partial", off.len(), cpu.len());
    assert!(between * 20 > cpu.len(), "{what}: {between} results of {} are between 0 and 1", cpu.len());
    let allowed = (cpu.len() as f64 * over) as usize;
    assert!(
        off.len() <= allowed,
        "{what}: {} of {} differ: {:?}",
        off.len(),
        cpu.len(),
        &off[..off.len().min(5)]
    );
}

pub(crate) struct Random(pub(crate) fastrand::Rng);

impl Random {
    pub(crate) fn new() -> Self {
        Self(fastrand::Rng::with_seed(7))
    }

    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + self.0.f64() * (high - low)
    }

    pub(crate) fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.within(-size, size)))
    }

    pub(crate) fn unit(&mut self) -> DVec3 {
        self.vector(1.0).try_normalize().unwrap_or(DVec3::Y)
    }

    /// Small, zero now and then.
    fn small(&mut self) -> f64 {
        if self.0.u32(..16) == 0 { 0.0 } else { self.within(-1.0, 1.0) * 10f64.powi(self.0.i32(-3..1)) }
    }

    fn light(&mut self) -> antumbra_math::Light {
        match self.0.u32(..3) {
            0 => antumbra_math::Light::Directional { direction: self.unit() },
            _ => antumbra_math::Light::Point { position: self.vector(8.0) },
        }
    }

    fn shape(&mut self) -> Shape {
        let (center, axis, size) = (self.vector(3.0), self.unit(), self.within(0.1, 2.0));
        match self.0.u32(..5) {
            0 => Sphere { center, radius: size }.into(),
            1 => Disc { center, normal: axis, radius: size }.into(),
            2 => Triangle { vertices: [center, center + self.vector(2.0), center + self.vector(2.0)] }.into(),
            3 => Cone { base_center: center, axis, radius: size, height: self.within(0.1, 2.0) }.into(),
            _ => {
                let right = axis.any_orthonormal_vector();
                Rectangle { center, half_right: right * size, half_forward: axis.cross(right) * 0.5 }.into()
            }
        }
    }

    /// A patch at `point`; a point without extent now and then.
    fn footprint(&mut self, point: DVec3) -> Footprint<Vec3> {
        let size = [0.0, 0.02, 0.1, 0.5][self.0.usize(..4)];
        let (dx, dy) = (self.vector(size).as_vec3(), self.vector(size).as_vec3());
        Footprint { point: point.as_vec3(), dx, dy }
    }
}

fn footprint_texels(f: &Footprint<Vec3>) -> [Vec4; 3] {
    [f.point, f.dx, f.dy].map(|v| v.extend(0.0))
}

#[test]
fn half_plane_coverage_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs: Vec<[Vec4; 1]> = (0..20_000)
            .map(|_| [Vec3::from_array([(); 3].map(|()| random.small() as f32)).extend(0.0)])
            .collect();
        // Edges and corners of the cases.
        let few = [0.0, -0.0, 0.25, 0.5, -0.5, 1.0, 1e-20, 1e20];
        inputs.extend(
            few.iter().flat_map(|&v| few.iter().flat_map(move |&x| few.map(|y| [Vec4::new(v, x, y, 0.0)]))),
        );
        let body = "vec4 i = INPUT(0); o_out = vec4(half_plane_coverage(i.x, i.y, i.z));";
        let Some(gpu) = on_gpu(gl, &[COVERAGE], body, &inputs) else { return };
        let cpu: Vec<f32> = inputs.iter().map(|[i]| half_plane_coverage(i.x, i.y, i.z)).collect();
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        // A division and a product or two: some units in the last place; where slopes or their
        // squares leave float32's range, some drivers flush to zero.
        assert_equal("half_plane_coverage", &gpu, &cpu, 2e-6, 1e-3);
    });
}

#[test]
fn screen_footprint_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let mut inputs = Vec::new();
        for i in 0..10_000u32 {
            let point = random.vector(3.0) - DVec3::Z * random.within(3.0, 40.0);
            let mut normal = random.unit();
            if i % 8 == 0 {
                normal = normal.cross(point).normalize(); // edge-on
            }
            let perspective = (i % 2) as f32;
            inputs.push([
                point.as_vec3().extend(perspective),
                normal.as_vec3().extend(0.0),
                Vec4::new(0.01, 0.02, 0.0, 0.0),
            ]);
        }
        let part = |axis: &str| {
            format!(
                "vec4 p = INPUT(0); Footprint f = screen_footprint(p.xyz, INPUT(1).xyz, vec3(INPUT(2).xy, p.w)); o_out = vec4(f.{axis}, 0.0);"
            )
        };
        for axis in ["dx", "dy"] {
            let Some(gpu) = on_gpu(gl, &[COVERAGE], &part(axis), &inputs) else { return };
            let mut off = 0;
            for ([p, n, s], gpu) in inputs.iter().zip(&gpu) {
                let f = screen_footprint(p.truncate(), n.truncate(), (s.x, s.y), p.w > 0.5);
                let cpu = if axis == "dx" { f.dx } else { f.dy };
                // Relative to the stretched footprint: edge-on the cosine is rounding error.
                off += usize::from(!((gpu.truncate() - cpu).length() <= 1e-3 * cpu.length()));
            }
            eprintln!("screen_footprint {axis}: {off} off");
            assert!(off <= inputs.len() / 1000, "{axis}: {off} of {} differ", inputs.len());
        }
    });
}

/// Corners by way of a polygon of two edges: the twin is private to its crate.
#[test]
fn corner_coverage_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let anywhere = (Vec3::ZERO, 1.0);
        let mut inputs = Vec::new();
        let mut cpu = Vec::new();
        for i in 0..20_000 {
            let mut edge =
                || Vec4::new(random.small() as f32, random.small() as f32, 0.0, random.small() as f32);
            let (a, mut b) = (edge(), edge());
            match i % 16 {
                0 => b = Vec4::new(a.x, a.y, 0.0, b.w),   // the same way
                1 => b = Vec4::new(-a.x, -a.y, 0.0, b.w), // facing each other
                2 => b = Vec4::new(-a.y, a.x, 0.0, b.w),  // at right angles
                _ => {}
            }
            inputs.push([a, b]);
            let plane = |e: Vec4| (e.truncate(), e.w);
            let polygon = PolygonBlocker { base: plane(a), edges: [plane(b), anywhere, anywhere, anywhere] };
            cpu.push(polygon_coverage(&polygon, &Footprint { point: Vec3::ZERO, dx: Vec3::X, dy: Vec3::Y }));
        }
        let body = "Footprint f = Footprint(vec3(0.0), vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)); \
                    vec4 a = INPUT(0); vec4 b = INPUT(1); \
                    o_out = vec4(corner_coverage(pixel_edge(a.w, a.xyz, f), pixel_edge(b.w, b.xyz, f)));";
        let Some(gpu) = on_gpu(gl, &[COVERAGE], body, &inputs) else { return };
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        // As for one edge, and a square root. Edges of one coverage, which is the nearer, may swap.
        assert_equal("corner_coverage", &gpu, &cpu, 1e-5, 1e-3);
    });
}

/// Every blocker, of random shapes and lights, at points in and near its shadow.
#[test]
fn blockers_are_their_twins() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = ([const { Vec::new() }; 3], [const { Vec::new() }; 3]);
        while inputs.iter().any(|list| list.len() < 20_000) {
            let (shape, light) = (random.shape(), random.light());
            for (blocker, _) in Blockers::new(&shape, &light).iter() {
                let exact = blocker;
                let blocker = blocker.to_f32();
                let (kind, mut texels) = match blocker {
                    Blocker::Sphere(b) => (0, vec![b.center.extend(b.radius), b.light.extend(b.light_w)]),
                    Blocker::Disc(b) => (
                        1,
                        vec![b.center.extend(b.radius), b.normal.extend(b.nearness), b.toward.extend(0.0)],
                    ),
                    Blocker::Polygon(b) => (2, b.planes().map(|(n, d)| n.extend(d)).to_vec()),
                };
                texels.resize(5, Vec4::ZERO);
                for _ in 0..8 {
                    // Half way between a lit point and one behind the shape, again and again: near an edge.
                    let center = shape.bounding_sphere().0;
                    let away = light.vector_from(center).normalize_or_zero() * -random.within(0.1, 4.0);
                    let mut dark = center + away;
                    let mut lit = dark + random.vector(4.0);
                    if exact.blocks(lit) != exact.blocks(dark) {
                        for _ in 0..random.0.u32(3..9) {
                            let middle = (lit + dark) * 0.5;
                            let half =
                                if exact.blocks(middle) == exact.blocks(lit) { &mut lit } else { &mut dark };
                            *half = middle;
                        }
                    }
                    let footprint = random.footprint(lit);
                    let [a, b, c] = footprint_texels(&footprint);
                    inputs[kind].push([a, b, c, texels[0], texels[1], texels[2], texels[3], texels[4]]);
                    cpu[kind].push(blocker.coverage(&footprint));
                }
            }
        }
        let body = "for (int i = 0; i < 5; i++) { blocker[i] = INPUT(3 + i); } \
                    SurfacePoint s; s.has_id = true; s.tolerance = 0.0; \
                    o_out = vec4(blocker_coverage(Footprint(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz), s));";
        // Units in the last place of coordinates of ten metres are some micrometres, a thousandth of
        // the smaller footprints; for points without extent they decide between 0 and 1, and in a
        // grazing shadow they are stretched.
        for (kind, (name, source)) in
            [("sphere", SPHERE), ("disc", DISC), ("polygon", POLYGON)].iter().enumerate()
        {
            let Some(gpu) = on_gpu(gl, &[COVERAGE, SURFACE, source], body, &inputs[kind]) else { return };
            let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
            assert_equal(name, &gpu, &cpu[kind], 1e-3, 1e-3);
        }
    });
}

#[test]
fn irradiance_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        for i in 0..20_000 {
            let color = random.vector(1.0).abs().as_vec3() * 10.0;
            let mut light = match i % 3 {
                0 => Light::point(random.vector(8.0), color),
                1 => Light::directional(random.unit(), color * 0.1),
                _ => {
                    let outer = random.within(0.05, 1.5) as f32;
                    Light::spot(
                        random.vector(8.0),
                        random.unit(),
                        outer * random.within(0.0, 1.0) as f32,
                        outer,
                        color,
                    )
                }
            };
            if i % 5 == 0 {
                light.attenuation = [1.0, 0.1, 0.05];
            }
            let light = ShaderLight::new(&light, &DMat4::IDENTITY);
            let position = if i % 100 == 0 { light.place.truncate() } else { random.vector(4.0).as_vec3() };
            let normal = random.unit().as_vec3();
            cpu.push(light.irradiance(position, normal));
            let [a, b, c, d] = [light.place, light.color, light.cone, light.attenuation];
            inputs.push([a, b, c, d, position.extend(0.0), normal.extend(0.0)]);
        }
        let body = "o_out = vec4(irradiance(INPUT(0), INPUT(1), INPUT(2), INPUT(3), INPUT(4).xyz, INPUT(5).xyz), 0.0);";
        let Some(gpu) = on_gpu(gl, &[AREA, LIGHTS], body, &inputs) else { return };
        let mut off = Vec::new();
        for (i, (gpu, cpu)) in gpu.iter().zip(&cpu).enumerate() {
            // A few units in the last place, relative; at the rim of a cone the falloff is steep.
            if !((gpu.truncate() - *cpu).abs().max_element() <= 1e-4 * cpu.max_element().max(1e-3)) {
                off.push((i, *gpu, *cpu));
            }
        }
        eprintln!("irradiance: {} of {} off", off.len(), cpu.len());
        let lit = cpu.iter().filter(|e| e.max_element() > 0.0).count();
        assert!(lit > cpu.len() / 4, "{lit} are lit");
        assert!(
            off.len() <= cpu.len() / 1000,
            "{} of {} differ: {:?}",
            off.len(),
            cpu.len(),
            &off[..off.len().min(5)]
        );
    });
}

/// Parts of composite shadows, at points in them, beside them and near their edges; of the size of a
/// room and a million times as large.
#[test]
fn part_coverage_is_its_twin() {
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        while inputs.len() < 20_000 {
            let plane = antumbra_math::Plane::through(random.vector(3.0), random.unit());
            let frame = PlaneFrame::of_plane(&plane).expect("a plane");
            let mut at = |size: f64| DVec2::new(random.within(-size, size), random.within(-size, size));
            let (a, b, c, edge) = (at(3.0), at(3.0), at(3.0), at(2.0));
            let shape = if random.0.bool() {
                PartShape::Triangle { vertices: [a, b, c] }
            } else {
                // Its edge near the middle of things, however large it is.
                let radius = 10f64.powf(random.within(-1.0, 6.0));
                PartShape::Disc { center: edge + a.normalize_or_zero() * radius, radius }
            };
            let Some(part) = PlacedPart::new(&shape, &frame) else { continue };
            let part = part.to_f32();
            let texels = match part {
                PlacedPart::Disc { center, radius, power } => {
                    [center.extend(radius), Vec4::X * power, Vec4::ZERO, Vec4::Y]
                }
                PlacedPart::Triangle { edges: [a, b, c] } => {
                    let plane = |(n, d): (Vec3, f32)| n.extend(d);
                    [plane(a), plane(b), plane(c), Vec4::ZERO]
                }
            };
            for _ in 0..4 {
                let near = DVec2::new(random.within(-0.3, 0.3), random.within(-0.3, 0.3));
                let footprint = random.footprint(frame.point(edge + near));
                let [p, x, y] = footprint_texels(&footprint);
                inputs.push([p, x, y, texels[0], texels[1], texels[2], texels[3]]);
                cpu.push(part_coverage(&part, &footprint));
            }
        }
        let body = "Footprint f = Footprint(INPUT(0).xyz, INPUT(1).xyz, INPUT(2).xyz); \
                    o_out = vec4(part_coverage(INPUT(3), INPUT(4), INPUT(5), INPUT(6), f));";
        let Some(gpu) = on_gpu(gl, &[COVERAGE, PART], body, &inputs) else { return };
        let gpu: Vec<f32> = gpu.iter().map(|r| r.x).collect();
        // As for blockers: units in the last place of some metres, against footprints of centimetres.
        assert_equal("part_coverage", &gpu, &cpu, 1e-3, 1e-3);
    });
}
