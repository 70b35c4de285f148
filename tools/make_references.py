#!/usr/bin/env python3
"""Renders the scenes of crates/antumbra-reference/tests/mitsuba with Mitsuba 3.

    python3 tools/make_references.py [SCENE ...]        # names without .toml; all by default

Needs Python 3.11 and the packages mitsuba (3.9.1 made the committed files) and numpy; no GPU. A few minutes on
two cores.

Reads   crates/antumbra-reference/tests/mitsuba/*.toml, scenes in antumbra's own format.
Writes  next to them NAME.exr, linear radiance in half floats (relative error up to 4.9e-4), noise.csv, the root mean square
        of each picture's Monte Carlo noise, absolute, from two renderings of half the samples each, and star.obj, the mesh
        that the scene `mesh` uses.

The test `mitsuba` of antumbra-reference compares, and `soft_pictures` of antumbra-host the scenes `soft-*`; they need none of
this. How the two worlds are mapped:

- point, spot: intensity in candela is Mitsuba's radiant intensity; directional: lux is its irradiance; sphere, disc,
  rectangle: radiance I / (pi R^2) or I / (width height), normals of disc and rectangle turned to where they shine.
- Surfaces are `twosided` `diffuse`, the reflectance is the colour. There is no ambient light: the scenes have none.
- Direct light alone, box filter: a pixel is the mean over its area, as with us. Emitters are hidden from the camera.
- Mitsuba has no box-shaped, capped or tapering solids but `cube`: cylinders are a `cylinder` and two `disk`s, frustum,
  cone, capsule, ellipsoid and torus are meshes of about a million triangles with exact normals at the vertices.
- Its spot light falls off linearly in the angle between the cones, glTF's quadratically in the cosine: the scene's cones
  lie 0.01 degrees apart.
"""

import math
import sys
import tempfile
import tomllib
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
from mitsuba import ScalarTransform4f as T  # noqa: E402  (exists once the variant is set)

FOLDER = Path(__file__).resolve().parent.parent / "crates/antumbra-reference/tests/mitsuba"
# Samples a pixel in each of the two halves; numbers that Mitsuba's multijitter need not round. Hard lights have noise at
# edges alone.
HARD, SOFT = 528, 1024


def rotation_matrix(quaternion):
    """Of a unit quaternion x y z w, as glTF has it."""
    x, y, z, w = np.array(quaternion) / np.linalg.norm(quaternion)
    m = np.eye(4)
    m[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return m


def pose(thing):
    m = rotation_matrix(thing.get("rotation", [0.0, 0.0, 0.0, 1.0]))
    m[:3, 3] = thing.get("translation", [0.0, 0.0, 0.0])
    return T(m)


def frame(position, normal, right):
    """A transform from Mitsuba's xy plane with normal +z."""
    normal = np.array(normal) / np.linalg.norm(normal)
    right = np.array(right) - normal * np.dot(right, normal)
    right /= np.linalg.norm(right)
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = right, np.cross(normal, right), normal, position
    return T(m)


def any_across(v):
    return np.cross(v, [1.0, 0.0, 0.0] if abs(v[0]) < 0.5 * np.linalg.norm(v) else [0.0, 1.0, 0.0])


class Temporary:
    """Numbered OBJ files of generated meshes."""

    def __init__(self, folder):
        self.folder, self.count = Path(folder), 0

    def grid(self, points, normals):
        """Writes a grid of points, rows by columns, as an OBJ file with normals; the path of the file."""
        rows, columns, _ = points.shape
        self.count += 1
        path = self.folder / f"grid{self.count}.obj"
        index = np.arange(rows * columns).reshape(rows, columns) + 1
        a, b, c, d = (index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:])
        faces = np.concatenate([np.stack([a, b, d], -1).reshape(-1, 3), np.stack([a, d, c], -1).reshape(-1, 3)])
        corners = points.reshape(-1, 3)[faces - 1]
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        with path.open("w") as file:
            np.savetxt(file, points.reshape(-1, 3), "v %.9g %.9g %.9g")
            np.savetxt(file, normals.reshape(-1, 3), "vn %.9g %.9g %.9g")
            np.savetxt(file, np.repeat(faces[area > 1e-14], 2, axis=1), "f %d//%d %d//%d %d//%d")
        return str(path)

    def revolved(self, profile, profile_normals, columns=1440):
        """The surface of revolution about +y of (radius, height) points, as a mesh."""
        phi = np.linspace(0.0, 2.0 * math.pi, columns + 1)
        across = np.stack([np.cos(phi), np.zeros_like(phi), np.sin(phi)], -1)

        def spin(rh):
            rh = np.asarray(rh, dtype=float)
            return rh[:, None, :1] * across[None] + rh[:, None, 1:] * np.array([0.0, 1.0, 0.0])

        return self.grid(spin(profile), spin(profile_normals))


def arc(begin, end, steps=360):
    angle = np.linspace(begin, end, steps + 1)
    return np.stack([np.cos(angle), np.sin(angle)], -1)


def pieces(shape, temporary):
    """Mitsuba shapes, without pose and material, that make up one of ours."""
    kind = shape["type"]
    lie = T().rotate([1, 0, 0], -90)  # z up to y up

    def disk(radius, height):
        return {"type": "disk", "to_world": T().translate([0, height, 0]) @ lie @ T().scale([radius, radius, 1])}

    def mesh(path):
        return {"type": "obj", "filename": path, "to_world": T()}

    def side(bottom, top, height):
        """The lateral surface of a cone; rows so that the triangles near an apex stay small."""
        t = np.linspace(0.0, 1.0, 361)
        rh = np.stack([bottom + (top - bottom) * t, height * (t - 0.5)], -1)
        n = np.array([height, bottom - top]) / math.hypot(height, bottom - top)
        return mesh(temporary.revolved(rh, np.broadcast_to(n, rh.shape)))

    if kind == "rectangle":
        size = [shape["width"] / 2, shape["depth"] / 2, 1]
        return [{"type": "rectangle", "to_world": lie @ T().scale(size)}]
    if kind == "disc":
        return [disk(shape["radius"], 0.0)]
    if kind == "triangle":
        path = temporary.folder / "triangle.obj"
        path.write_text("".join("v {} {} {}\n".format(*v) for v in shape["vertices"]) + "f 1 2 3\n")
        return [mesh(str(path)) | {"face_normals": True}]
    if kind == "sphere":
        return [{"type": "sphere", "to_world": T().scale(shape["radius"])}]
    if kind == "box":
        return [{"type": "cube", "to_world": T().scale([s / 2 for s in shape["size"]])}]
    if kind == "cylinder":
        radius, height = shape["radius"], shape["height"]
        top = shape.get("radius_top", radius)
        ends = [disk(radius, -height / 2), disk(top, height / 2)]
        if top != radius:
            return [side(radius, top, height), *ends]
        ends_at = {"p0": [0, -height / 2, 0], "p1": [0, height / 2, 0]}
        return [{"type": "cylinder", "radius": radius, **ends_at, "to_world": T()}, *ends]
    if kind == "cone":
        return [side(shape["radius"], 0.0, shape["height"]), disk(shape["radius"], -shape["height"] / 2)]
    if kind == "capsule":
        normals = np.concatenate([arc(-math.pi / 2, 0.0), arc(0.0, math.pi / 2)])
        middle = np.zeros_like(normals)
        middle[:361, 1], middle[361:, 1] = -shape["height"] / 2, shape["height"] / 2
        return [mesh(temporary.revolved(middle + shape["radius"] * normals, normals))]
    if kind == "torus":
        normals = arc(-math.pi, math.pi, 720)
        rh = np.array([shape["major_radius"], 0.0]) + shape["minor_radius"] * normals
        return [mesh(temporary.revolved(rh, normals))]
    if kind == "ellipsoid":
        theta, phi = np.meshgrid(np.linspace(0, math.pi, 361), np.linspace(0, 2 * math.pi, 1441), indexing="ij")
        unit = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)], -1)
        normals = unit / np.array(shape["radii"])
        normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
        return [mesh(temporary.grid(unit * np.array(shape["radii"]), normals))]
    if kind == "mesh":
        return [mesh(str(FOLDER / shape["path"])) | {"face_normals": True}]
    raise SystemExit(f"no counterpart of the shape {kind}")


def emitter(light):
    color = np.array(light.get("color", [1.0, 1.0, 1.0])) * light["intensity"]
    kind = light["type"]

    def rgb(value):
        return {"type": "rgb", "value": [float(v) for v in value]}

    if kind == "point":
        return {"type": "point", "position": light["position"], "intensity": rgb(color)}
    if kind == "directional":
        return {"type": "directional", "direction": light["direction"], "irradiance": rgb(color)}
    if kind == "spot":
        target = [p + d for p, d in zip(light["position"], light["direction"])]
        aim = T().look_at(light["position"], target, list(any_across(light["direction"])))
        angles = {"cutoff_angle": light["outer_angle"], "beam_width": light["inner_angle"]}
        return {"type": "spot", "to_world": aim, "intensity": rgb(color), **angles}
    if kind == "sphere":
        radius = light["radius"]
        area = {"type": "area", "radiance": rgb(color / (math.pi * radius**2))}
        return {"type": "sphere", "center": light["position"], "radius": radius, "emitter": area}
    if kind == "disc":
        radius = light["radius"]
        area = {"type": "area", "radiance": rgb(color / (math.pi * radius**2))}
        place = frame(light["position"], light["direction"], any_across(light["direction"]))
        return {"type": "disk", "to_world": place @ T().scale([radius, radius, 1]), "emitter": area}
    if kind == "rectangle":
        width, height = light["width"], light["height"]
        area = {"type": "area", "radiance": rgb(color / (width * height))}
        place = frame(light["position"], light["direction"], light["right"])
        return {"type": "rectangle", "to_world": place @ T().scale([width / 2, height / 2, 1]), "emitter": area}
    raise SystemExit(f"no counterpart of the light {kind}")


def build(scene, temporary):
    camera, image = scene["camera"], scene["image"]
    target, up = camera.get("target", [0.0, 0.0, 0.0]), camera.get("up", [0.0, 1.0, 0.0])
    result = {
        "type": "scene",
        "integrator": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 1, "hide_emitters": True},
        "sensor": {
            "type": "perspective",
            "fov": camera["fov_y"],
            "fov_axis": "y",
            "near_clip": 0.01,
            "to_world": T().look_at(camera["eye"], target, up),
            "film": {
                "type": "hdrfilm",
                "width": image["width"],
                "height": image["height"],
                "rfilter": {"type": "box"},
                "pixel_format": "rgb",
                "component_format": "float32",
            },
            "sampler": {"type": "multijitter", "sample_count": 16},
        },
    }
    for number, light in enumerate(scene.get("light", [])):
        result[f"light{number}"] = emitter(light)
    for number, thing in enumerate(scene.get("object", [])):
        reflectance = {"type": "rgb", "value": thing.get("color", [0.8, 0.8, 0.8])}
        material = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": reflectance}}
        for part, piece in enumerate(pieces(thing["shape"], temporary)):
            piece["to_world"] = pose(thing) @ piece["to_world"]
            result[f"object{number}part{part}"] = piece | {"bsdf": material}
    return mi.load_dict(result)


def write_star(path):
    """A closed ball of 24 by 16 quads folded into deep ridges, each of which shadows the next."""
    columns, rows = 24, 16
    vertices, faces = [], []
    for row in range(rows + 1):
        theta = math.pi * row / rows
        for column in range(columns):
            phi = 2 * math.pi * column / columns
            radius = 1.0 if (row + column) % 2 else 0.6
            v = (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi))
            vertices.append("v {:.6f} {:.6f} {:.6f}".format(*(0.95 * radius * c for c in v)))
    for row in range(rows):
        for column in range(columns):
            a, b = row * columns + column + 1, row * columns + (column + 1) % columns + 1
            c, d = a + columns, b + columns
            faces += [f"f {a} {b} {d}", f"f {a} {d} {c}"]
    path.write_text("\n".join(["# Written by tools/make_references.py.", *vertices, *faces]) + "\n")


def main():
    write_star(FOLDER / "star.obj")
    names = sys.argv[1:] or sorted(path.stem for path in FOLDER.glob("*.toml"))
    table = FOLDER / "noise.csv"
    noise = dict(line.split(",") for line in table.read_text().split()[1:]) if table.exists() else {}
    for name in names:
        scene = tomllib.loads((FOLDER / f"{name}.toml").read_text())
        soft = any(light["type"] in ("sphere", "disc", "rectangle") for light in scene["light"])
        samples = SOFT if soft else HARD
        with tempfile.TemporaryDirectory() as folder:
            world = build(scene, Temporary(folder))
            first, second = (np.array(mi.render(world, spp=samples, seed=seed)) for seed in (1, 2))
        # The mean of two halves has half the deviation of their difference.
        noise[name] = f"{0.5 * math.sqrt(np.mean((first - second) ** 2)):.3e}"
        bitmap = mi.Bitmap(((first + second) / 2).astype(np.float32), mi.Bitmap.PixelFormat.RGB)
        bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float16, False).write(str(FOLDER / f"{name}.exr"))
        print(f"{name}: {2 * samples} samples a pixel, noise {noise[name]}, mean {np.mean(first):.4f}", flush=True)
        table.write_text("scene,noise\n" + "".join(f"{k},{noise[k]}\n" for k in sorted(noise)))


if __name__ == "__main__":
    main()
