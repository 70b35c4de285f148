//! What a technique cannot do of a scene, in words.

use crate::describe::{Described, describe};
use crate::{HostError, Ways};
use antumbra::{Part, Soft, Technique};
use antumbra_scene::{Moment, Scene};

/// What a technique cannot do of a scene: names the object, and what can. `None` if it can do it.
///
/// Describes the scene; of one that is described already, [`Setting::objection`](crate::Setting::objection) says the same.
pub fn objection(scene: &Scene, moment: &Moment, technique: &Technique, soft: Soft) -> Option<HostError> {
    match describe(scene, moment) {
        Ok(described) => {
            let name = |object: usize| scene.objects.get(object).map(|object| object.name.as_str());
            objection_to(&described, moment, &name, technique, soft)
        }
        Err(error) => Some(error),
    }
}

/// As [`objection`], of what is described. `name` tells an object's by its index.
pub(crate) fn objection_to<'a>(
    described: &Described,
    moment: &Moment,
    name: &dyn Fn(usize) -> Option<&'a str>,
    technique: &Technique,
    soft: Soft,
) -> Option<HostError> {
    let scenery = described.scenery();
    let refusal = technique.refusal_with(soft, &scenery)?;
    let owner = |id: u32| moment.primitives.get((id as usize).checked_sub(1)?);
    let named = |id: u32| match owner(id).and_then(|primitive| name(primitive.object)) {
        Some(name) => format!("object \"{name}\""),
        None => "an object".into(),
    };
    let mut what = format!("the technique {} {}", technique.name(), refusal.reason);
    let object = match refusal.part {
        Part::Light(i) => match moment.lights.get(i) {
            Some(light) => format!("light \"{}\"", light.name),
            None => "a light".into(),
        },
        Part::Occluder(i) => named(described.occluders[i].id),
        Part::Mesh(i) => {
            let id = described.meshes[i].id;
            if let Some(kind) =
                owner(id).map(|primitive| primitive.shape.type_name()).filter(|k| *k != "mesh")
            {
                what += &format!(", and this {kind} is drawn as one");
            }
            named(id)
        }
        Part::Options => "the options".into(),
        _ => "the scene".into(),
    };
    Some(HostError::Unsupported { object, what, ways: Ways::of(technique, soft, &scenery) })
}
