//! Wavefront OBJ, read by `tobj`: vertices and faces; faces with more than three corners are cut into
//! a fan, or by `earcut` where a fan would not do. Lines, points, normals, colours, texture coordinates, groups and
//! materials have no part in shadows and are passed over.

use std::borrow::Cow;
use std::io::Cursor;

use glam::DVec3;

use crate::mesh_builder::{Builder, MeshError};

/// Adds the triangles of an OBJ file to `mesh`.
pub(crate) fn read(bytes: &[u8], mesh: &mut Builder) -> Result<(), MeshError> {
    let file = decoded(bytes);
    let text = geometry(&file);
    let mut unread = Cursor::new(text.as_bytes());
    let options = tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..Default::default() };
    let (models, _) = tobj::load_obj_buf(&mut unread, &options, |_| {
        tobj::MTLLoadResult::Err(tobj::LoadError::GenericFailure)
    })
    .map_err(|error| match error {
        // Found on the line that was read last; the others, when all have been.
        tobj::LoadError::PositionParseError
        | tobj::LoadError::ScalingByZeroError
        | tobj::LoadError::ColorParseError
        | tobj::LoadError::FaceParseError => {
            let read = text.as_bytes().iter().take(unread.position() as usize);
            let kept = read.filter(|byte| **byte == b'\n').count().saturating_sub(1);
            on_line(MeshError::malformed(error), statements(&file).nth(kept))
        }
        _ => MeshError::malformed(error),
    })?;
    for model in &models {
        let first = mesh.vertices();
        let positions: Vec<DVec3> =
            model.mesh.positions.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2])).collect();
        let (mut rest, arities) = (&model.mesh.indices[..], &model.mesh.face_arities);
        let faces = if arities.is_empty() { rest.len() / 3 } else { arities.len() };
        // A face of n corners is n - 2 triangles.
        mesh.expect(positions.len(), rest.len().saturating_sub(2 * faces))?;
        for p in &positions {
            mesh.vertex(*p).map_err(|e| on_line(e, statements(&file).find(|(_, line)| is_at(line, *p))))?;
        }
        for face in 0..faces {
            let corners;
            (corners, rest) = rest.split_at(arities.get(face).map_or(3, |n| *n as usize).min(rest.len()));
            for t in cut(corners, &positions)? {
                // Both are far below 2^32: the limit on vertices is 2^24.
                mesh.triangle(t.map(|i| i.saturating_add(first as u32)))?;
            }
        }
    }
    Ok(())
}

/// The text, with every line ended as on Unix: UTF-8, or UTF-16 where a byte order mark says so.
fn decoded(bytes: &[u8]) -> String {
    let wide = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|b| unit([b[0], b[1]])).collect();
        String::from_utf16_lossy(&units)
    };
    let text = match bytes {
        [0xFE, 0xFF, ..] => wide(u16::from_be_bytes),
        [0xFF, 0xFE, ..] => wide(u16::from_le_bytes),
        [0xEF, 0xBB, 0xBF, rest @ ..] => String::from_utf8_lossy(rest).into_owned(),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    };
    if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n") } else { text }
}

/// Most corners of a face that is not convex: cutting may take the square of their number.
const MAX_CORNERS: usize = 1 << 14;

/// The triangles of a polygon. A fan keeps every corner, so that a neighbour's corner in the middle of
/// a straight side opens no slit; it is right where none of its triangles is turned against the polygon,
/// as in every convex one. Others are cut by the ears in the plane that fits best.
fn cut(corners: &[u32], positions: &[DVec3]) -> Result<Vec<[u32; 3]>, MeshError> {
    let [center, rim @ ..] = corners else {
        return Err(MeshError::malformed("invalid polygon without corners"));
    };
    let fan: Vec<[u32; 3]> = rim.windows(2).map(|w| [*center, w[0], w[1]]).collect();
    let at = |i: u32| positions.get(i as usize).copied().unwrap_or_default();
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(at);
        (b - a).cross(c - a)
    };
    // The sum over the fan is the polygon's area whatever its form.
    let normal: DVec3 = fan.iter().map(area).sum();
    let turned = fan.iter().any(|t| area(t).dot(normal) < 0.0);
    let Some(normal) = normal.try_normalize().filter(|_| turned) else { return Ok(fan) };
    if corners.len() > MAX_CORNERS {
        return Err(MeshError::too_large(format!(
            "a face that is not convex has {} corners, more than {MAX_CORNERS}",
            corners.len()
        )));
    }
    let (u, v) = normal.any_orthonormal_pair();
    let flat = corners.iter().map(|&i| [u.dot(at(i)), v.dot(at(i))]);
    let mut ears: Vec<u32> = Vec::new();
    earcut::Earcut::new().earcut(flat, &[], &mut ears);
    let ears: Vec<[u32; 3]> = ears
        .as_chunks::<3>()
        .0
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|k| corners[k as usize]);
            if area(&[a, b, c]).dot(normal) < 0.0 { [a, c, b] } else { [a, b, c] }
        })
        .collect();
    Ok(if ears.is_empty() { fan } else { ears })
}

/// The lines with vertices and faces, as the parser gets them. Beside saving work, this keeps the
/// parser off what it computes with unchecked: indices of normals and texture coordinates, which
/// it looks at only where a file has some, and paths of material files; and off the colours of vertices, which it
/// refuses where not every vertex has one.
fn geometry(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    for (_, line) in statements(text) {
        let mut words = line.split_whitespace();
        if line.starts_with('v') && words.clone().nth(6).is_some() {
            for word in words.by_ref().take(4) {
                kept.push_str(word);
                kept.push(' ');
            }
        } else {
            kept.push_str(&line);
        }
        kept.push('\n');
    }
    kept
}

/// The lines with vertices and faces, without comments, each with the number of its line in the file, from 1. A line
/// that ends in a backslash goes on in the next.
fn statements(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = text.lines().zip(1..);
    core::iter::from_fn(move || {
        let (line, number) = lines.next()?;
        let Some(start) = line.strip_suffix('\\') else { return Some((number, Cow::Borrowed(line))) };
        let mut whole = start.to_owned();
        for (line, _) in lines.by_ref() {
            whole.push(' ');
            match line.strip_suffix('\\') {
                Some(part) => whole.push_str(part),
                None => {
                    whole.push_str(line);
                    break;
                }
            }
        }
        Some((number, Cow::Owned(whole)))
    })
    .map(|(number, line)| match line {
        Cow::Borrowed(line) => (number, Cow::Borrowed(without_comment(line))),
        Cow::Owned(line) => (number, Cow::Owned(without_comment(&line).to_owned())),
    })
    .filter(|(_, line)| line.split_whitespace().next().is_some_and(|word| word == "v" || word == "f"))
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// Whether a line is that of a vertex at `p`, not-a-number included.
fn is_at(line: &str, p: DVec3) -> bool {
    let mut words = line.split_whitespace();
    if words.next() != Some("v") {
        return false;
    }
    let mut number = || words.next().and_then(|word| word.parse::<f64>().ok());
    let at = [number(), number(), number()];
    // Alone, a fourth number divides; with others, it is a colour.
    let divisor = number().filter(|_| number().is_none()).unwrap_or(1.0);
    at.iter()
        .zip(p.to_array())
        .all(|(a, p)| a.is_some_and(|a| a / divisor == p || (a / divisor).is_nan() && p.is_nan()))
}

/// The error with the line that it is about.
fn on_line(error: MeshError, statement: Option<(usize, Cow<'_, str>)>) -> MeshError {
    match statement {
        Some((line, _)) => MeshError::new(format!("{}, on line {line}", error.what), error.instead),
        None => error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(text: &str) -> Result<crate::Mesh, MeshError> {
        let mut builder = Builder::new(100, 100);
        read(text.as_bytes(), &mut builder)?;
        builder.finish("test.obj")
    }

    #[test]
    fn quads_groups_and_relative_indices() {
        let m = mesh(
            "mtllib x.mtl\no a\nv 0 0 0\nv 1 0 0 # corner\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n\
             usemtl red\nf 1/1/1 2/1/1 3/1/1 4/1/1\ng b\nv 0.1 0.2 1\nf -1 -2 \\\n -3\nl 1 2\np 1\n",
        )
        .expect("a valid file");
        assert_eq!(m.triangles.len(), 3, "a quad and a triangle: {m:?}");
        assert_eq!(m.positions[m.triangles[2][0] as usize], DVec3::new(0.1, 0.2, 1.0), "in float64");
    }

    #[test]
    fn polygons_that_are_not_convex_are_cut_inside() {
        // An arrowhead whose first corner does not see all others, and a frame with a slit.
        for (text, corners, area) in [
            ("v 2 0 0\nv 0 2 0\nv 0.5 0 0\nv 0 -2 0\nf 1 2 3 4\n", 4, 3.0),
            ("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 2 3 4 1\n", 4, 1.0),
            (
                "v 0 0 7\nv 4 0 7\nv 4 4 7\nv 0 4 7\nv 0 2 7\nv 1 2 7\nv 1 3 7\nv 3 3 7\nv 3 1 7\nv 1 1 7\n\
                 v 1 2 7\nv 0 2 7\nf 1 2 3 4 5 6 7 8 9 10 11 12\n",
                12,
                12.0,
            ),
        ] {
            let m = mesh(text).expect("a valid file");
            let areas: Vec<f64> = m
                .triangles
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|i| m.positions[i as usize]);
                    0.5 * (b - a).cross(c - a).z
                })
                .collect();
            assert!(m.triangles.len() <= corners - 2, "{m:?}");
            assert!((areas.iter().sum::<f64>().abs() - area).abs() < 1e-12, "{areas:?} are {area}");
            let (least, most) = areas.iter().fold((0.0_f64, 0.0_f64), |(l, h), a| (l.min(*a), h.max(*a)));
            assert!(least * most == 0.0, "all on one side: {areas:?}");
        }
    }

    #[test]
    fn text_may_be_utf_16_where_it_says_so() {
        let text = "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n";
        let mut big = vec![0xFE, 0xFF];
        big.extend(text.encode_utf16().flat_map(u16::to_be_bytes));
        let mut little = vec![0xFF, 0xFE];
        little.extend(text.encode_utf16().flat_map(u16::to_le_bytes));
        let marked = [&[0xEF, 0xBB, 0xBF], text.as_bytes()].concat();
        for bytes in [&big[..], &little, &marked, &little[..little.len() - 1]] {
            let mut builder = Builder::new(100, 100);
            assert!(read(bytes, &mut builder).is_ok(), "{bytes:?}");
            assert_eq!(builder.vertices(), 3, "{bytes:?}");
        }
    }

    #[test]
    fn lines_may_end_as_on_any_system() {
        let text = "# a\nv 0 0 0\nv 1 0 0\nv 0 \\\n1 0\nf 1 2 3\n";
        for end in ["\n", "\r\n", "\r"] {
            let m = mesh(&text.replace('\n', end)).unwrap_or_else(|e| panic!("{end:?}: {}", e.what));
            assert_eq!((m.positions.len(), m.triangles.len()), (3, 1), "{end:?}: {m:?}");
            let bad = text.replace("1 0 0", "1 0 x").replace('\n', end);
            let what = mesh(&bad).expect_err("x is no number").what;
            assert!(what.ends_with("on line 3"), "{end:?}: {what}");
        }
    }

    #[test]
    fn some_vertices_may_have_colours() {
        let text = "v 0 0 0\nv 2 0 0 0.5 0.5 0.5\nv 0 2 0 1 0 0 1\nv 0 0 4 2\nf 1 2 3\nf 1 2 4\n";
        let m = mesh(text).unwrap_or_else(|e| panic!("{}", e.what));
        // A fourth number alone is no colour: it divides.
        let corners = [DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0, DVec3::Z * 2.0];
        assert_eq!(m.positions, corners, "colours move nothing");
    }

    #[test]
    fn a_bad_vertex_is_named_by_its_line() {
        let good = "# comment\nv 0 0 0\nv 1 0 \\\n0\n\n";
        for (bad, line) in [
            ("v nan 0 0\n", 6),
            ("v 0 0 0\nv 0 inf 0 1 1 1\n", 7),
            ("vn nan 0 0\nv -1e300 2 3 1e-300 # far\n", 7),
            ("v 1 2 3 1e-9\n", 6),
        ] {
            let error = mesh(&format!("{good}{bad}f 1 2 -1\n")).expect_err(bad);
            assert!(error.what.ends_with(&format!(", on line {line}")), "{bad:?} gives {:?}", error.what);
        }
        assert!(mesh("v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n").is_ok(), "no triangle has it");
        let error = mesh("v 0 0 0\nv 1 0 0\nv 0 0 0\nf 1 2 q\n").expect_err("q is no corner");
        assert!(error.what.ends_with("face parse error, on line 4"), "{}", error.what);
    }

    #[test]
    fn malformed_files_are_errors() {
        for (text, fragment) in [
            ("", "no triangle"),
            ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle with an area"),
            ("v 0 0\nf 1 2 3\n", "position parse error"),
            ("v 0 0 0\nf 1 2 3\n", "out of bounds"),
            ("v 0 0 0\nf 0 0 0\n", "out of bounds"),
            ("v 0 0 0\nf 1 1 -9223372036854775808\n", "out of bounds"),
            ("v 0 0 0\nf 1 1 9223372036854775807\n", "out of bounds"),
            ("v 0 0 0\nf 1 1 99999999999999999999\n", "face parse error"),
            ("v 0 0 0\nf\n", "invalid polygon"),
            ("v 0 0 0\nf a b c\n", "face parse error"),
            ("v 0 0 0\nf 1/2/3/4/5 1 1\n", "face parse error"),
            ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not finite, on line 1"),
            ("v 0 0 1e7\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "beyond 1e6, on line 1"),
            ("v 0 0 1 0\n", "scaling"),
        ] {
            let what = mesh(text).expect_err(text).what;
            assert!(what.contains(fragment), "{text:?} gives {what:?}");
        }
        let many = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{}", "f 1 2 3\n".repeat(101));
        let what = mesh(&many).expect_err("101 triangles").what;
        assert!(what.contains("too large"), "{what}");
        assert!(
            mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//6148914691236517206 2 3\n").is_ok(),
            "normals do not matter"
        );
    }
}
