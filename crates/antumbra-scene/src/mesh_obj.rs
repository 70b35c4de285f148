//! Wavefront OBJ, read by `tobj`: vertices and faces; faces with more than three corners are cut into
//! a fan, right for convex ones. Lines, points, normals, texture coordinates, groups and materials
//! have no part in shadows and are passed over.

use glam::DVec3;

use crate::mesh::{Builder, MeshError};

/// Adds the triangles of an OBJ file to `mesh`.
pub(crate) fn read(bytes: &[u8], mesh: &mut Builder) -> Result<(), MeshError> {
    let text = geometry(&String::from_utf8_lossy(bytes));
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| {
        tobj::MTLLoadResult::Err(tobj::LoadError::GenericFailure)
    })
    .map_err(MeshError::malformed)?;
    for model in &models {
        let first = mesh.vertices();
        mesh.expect(model.mesh.positions.len() / 3, model.mesh.indices.len() / 3)?;
        for p in model.mesh.positions.chunks_exact(3) {
            mesh.vertex(DVec3::new(p[0], p[1], p[2]))?;
        }
        for t in model.mesh.indices.chunks_exact(3) {
            // Both are far below 2^32: the limit on vertices is 2^24.
            mesh.triangle([t[0], t[1], t[2]].map(|i| i.saturating_add(first as u32)))?;
        }
    }
    Ok(())
}

/// The lines with vertices and faces, with continued lines joined. Beside saving work, this keeps the
/// parser off what it computes with unchecked: indices of normals and texture coordinates, which
/// it looks at only where a file has some, and paths of material files.
fn geometry(text: &str) -> String {
    let text = text.replace("\\\r\n", " ").replace("\\\n", " ");
    let mut kept = String::with_capacity(text.len());
    for line in text.lines() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.split_whitespace().next().is_some_and(|word| word == "v" || word == "f") {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    kept
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
            ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"),
            ("v 0 0 1e7\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "beyond 1e6"),
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
