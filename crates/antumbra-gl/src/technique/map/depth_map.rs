//! A light's map, for programs that show it.

use super::State;
use super::fit::Fit;
use crate::gl::RasterGuard;
use crate::input::{Error, Light, Texture};
use crate::masks::{DepthMap, DepthScale, MapFace};
use crate::technique::Pass;

impl State {
    /// Draws a light's map and says where it is.
    ///
    /// # Safety
    /// As for [`super::super::Method::draw_visibility`].
    pub(super) unsafe fn draw_shown(
        &mut self,
        pass: &Pass<'_>,
        light: &Light,
    ) -> Result<Option<DepthMap>, Error> {
        let Some(fit) = self.fit(pass, light) else { return Ok(None) };
        // SAFETY: the caller's.
        unsafe {
            let _raster = RasterGuard::new(pass.gl, pass.host);
            self.draw_fitted(pass, &fit)?;
        }
        let Some((texture, _)) = self.target.objects() else { return Ok(None) };
        let mut faces = [None; 6];
        let used = faces.iter_mut().zip(&fit.faces).filter_map(|(shown, face)| Some((shown, face.as_ref()?)));
        for (tile, (shown, face)) in (0..).zip(used) {
            let corner = self.target.corner(tile);
            let to_map = face.to_texels(corner, f64::from(self.options.size));
            *shown = Some(MapFace { corner: corner.as_uvec2().to_array(), to_map });
        }
        Ok(Some(DepthMap {
            texture: Texture::own(texture),
            size: self.target.size(),
            side: self.options.size,
            scale: fit.some_face.depth(),
            range: self.range(&fit),
            cube: fit.cube,
            faces,
        }))
    }

    /// See [`DepthMap::range`].
    fn range(&self, fit: &Fit) -> [f64; 2] {
        let (first, last) = match fit.some_face.depth() {
            DepthScale::Central { near } => (near, f64::INFINITY),
            DepthScale::Parallel { near, far } => (near, far),
        };
        let in_faces = fit.faces.iter().flatten().flat_map(|face| {
            self.around.casters.iter().filter(|caster| !face.misses(caster)).map(|c| face.depths(c))
        });
        let all = in_faces.reduce(|(a, b), (low, high)| (a.min(low), b.max(high)));
        let (low, high) =
            all.unwrap_or(if last.is_finite() { (first, last) } else { (fit.nearest, 8.0 * fit.nearest) });
        [low, high].map(|end| end.max(first).min(last))
    }
}
