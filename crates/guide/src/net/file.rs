//! The bytes of a network, in the safetensors format.
//!
//! | entry | type and shape |
//! | --- | --- |
//! | `weights` | `f32`, all weights, rows padded to eight |
//! | `features` | `f32`, (features, 2): mean, and one over the deviation |
//! | metadata `niwaki` | JSON: the version of this format, the form, and the caller's text |
//!
//! Equal networks and texts give equal bytes.

use super::form::{Layout, NetForm};
use super::pass::Net;
use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fmt;

/// The version of the format.
const VERSION: u32 = 1;
/// Most weights of a file: the size in a form is checked before memory is reserved for it.
const LARGEST: usize = 1 << 28;

/// The fault in the bytes of a network, as a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFile(String);

impl fmt::Display for BadFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for BadFile {}

impl BadFile {
    pub(crate) fn new(fault: String) -> BadFile {
        BadFile(fault)
    }
}

/// The metadata of a file.
#[derive(Serialize, Deserialize)]
struct About<F> {
    version: u32,
    form: F,
    text: String,
}

/// The name of the metadata's entry.
const ENTRY: &str = "niwaki";

/// The bytes of a network with a text of the caller.
pub fn write(net: &Net, text: &str) -> Vec<u8> {
    write_as(ENTRY, &net.form, text, &net.weights, &net.features)
}

/// The bytes of a network; `entry` names its kind in the metadata.
pub(crate) fn write_as<F: Serialize>(
    entry: &str,
    form: &F,
    text: &str,
    weights: &[f32],
    features: &[(f32, f32)],
) -> Vec<u8> {
    let about = About { version: VERSION, form, text: text.into() };
    let bytes =
        |numbers: &mut dyn Iterator<Item = f32>| numbers.flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
    let weights_bytes = bytes(&mut weights.iter().copied());
    let features_bytes = bytes(&mut features.iter().flat_map(|(mean, scale)| [*mean, *scale]));
    let view = |shape: Vec<usize>, data| TensorView::new(Dtype::F32, shape, data).expect("sizes agree");
    let tensors = [
        ("features", view(vec![features.len(), 2], &features_bytes)),
        ("weights", view(vec![weights.len()], &weights_bytes)),
    ];
    let json = serde_json::to_string(&about).expect("plain data");
    // A single entry, since the order of several would vary.
    let metadata = HashMap::from([(entry.to_owned(), json)]);
    safetensors::serialize(tensors, Some(metadata)).expect("two small tensors")
}

/// The form and the text in a network's bytes; `None` if the metadata lacks this entry.
pub(crate) fn read_form<F: DeserializeOwned>(
    entry: &str,
    bytes: &[u8],
) -> Result<Option<(F, String)>, BadFile> {
    let (_, header) = SafeTensors::read_metadata(bytes)
        .map_err(|e| BadFile(format!("not a whole file of the safetensors format ({e})")))?;
    let Some(json) = header.metadata().as_ref().and_then(|entries| entries.get(entry)) else {
        return Ok(None);
    };
    let version =
        serde_json::from_str::<serde_json::Value>(json).ok().and_then(|v| v.get("version")?.as_u64());
    if version != Some(VERSION.into()) {
        let written_in = version.map_or("none".into(), |v| v.to_string());
        return Err(BadFile(format!(
            "written in version {written_in} of the format; this engine reads version {VERSION}"
        )));
    }
    let About { form, text, .. } = serde_json::from_str(json)
        .map_err(|e| BadFile(format!("the description of the network is damaged ({e})")))?;
    Ok(Some((form, text)))
}

/// The weights and the features in a network's bytes, as many as these numbers.
#[expect(clippy::type_complexity, reason = "the two tensors of the file")]
pub(crate) fn read_numbers(
    bytes: &[u8],
    weights: usize,
    features: usize,
) -> Result<(Vec<f32>, Vec<(f32, f32)>), BadFile> {
    let bad = |fault: String| BadFile(fault);
    if weights > LARGEST {
        return Err(bad(format!("a network of {weights} weights is too large")));
    }
    let tensors =
        SafeTensors::deserialize(bytes).map_err(|e| bad(format!("the weights are damaged ({e})")))?;
    let numbers = |name: &str, shape: &[usize]| {
        let tensor = tensors.tensor(name).map_err(|_| bad(format!("there is no tensor `{name}`")))?;
        if tensor.dtype() != Dtype::F32 || tensor.shape() != shape {
            let (kind, actual) = (tensor.dtype(), tensor.shape());
            return Err(bad(format!(
                "`{name}` is {kind:?} of shape {actual:?}; its network needs F32 of {shape:?}"
            )));
        }
        let numbers: Vec<f32> =
            tensor.data().chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        match numbers.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(bad(format!("number {k} of `{name}` is {}", numbers[k]))),
            None => Ok(numbers),
        }
    };
    let weights = numbers("weights", &[weights])?;
    let features = numbers("features", &[features, 2])?.chunks_exact(2).map(|p| (p[0], p[1])).collect();
    Ok((weights, features))
}

/// The network and the text in some bytes.
pub fn read(bytes: &[u8]) -> Result<(Net, String), BadFile> {
    let Some((form, text)) = read_form::<NetForm>(ENTRY, bytes)? else {
        return Err(BadFile("a safetensors file, but not a guide: it has no entry `niwaki`".into()));
    };
    let sizes = [form.windows, form.features, form.hidden[0], form.hidden[1], form.heads.len()];
    if sizes.iter().any(|n| *n > 1 << 14)
        || form.hidden.contains(&0)
        || !form.heads.iter().all(|h| h.is_sound())
    {
        return Err(BadFile(format!(
            "a network of sizes {sizes:?} (windows, features, hidden layers, sites) cannot be"
        )));
    }
    let layout = Layout::new(&form);
    let (weights, features) = read_numbers(bytes, layout.len, form.features)?;
    Ok((Net { form, layout, weights, features, fresh: false }, text))
}

#[cfg(test)]
mod tests {
    //! Networks survive writing and reading; damaged bytes give a message, never a panic.
    use super::*;
    use crate::heads::Head;

    fn net() -> Net {
        let heads = vec![Head::Normal { components: 4 }, Head::Finite { values: 3 }];
        Net::start(NetForm { windows: 5, features: 2, hidden: [7, 6], heads }, 3)
    }

    #[test]
    fn networks_and_texts_survive_writing_and_reading() {
        let net = net();
        let bytes = write(&net, "vines \"1\"");
        assert_eq!(bytes, write(&net, "vines \"1\""));
        let (back, text) = read(&bytes).unwrap();
        assert_eq!((back.weights, back.features, back.form), (net.weights, net.features, net.form));
        assert_eq!(text, "vines \"1\"");
    }

    #[test]
    fn damaged_files_are_refused_with_a_reason() {
        let whole = write(&net(), "");
        let reason = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        for cut in [0, 4, 9, 60, whole.len() - 1] {
            assert!(reason(&whole[..cut]).starts_with("not a whole file"), "{cut}");
        }
        let replaced = |from: &str, to: &str| {
            let text: String = whole.iter().map(|b| char::from(*b)).collect();
            assert_eq!(from.len(), to.len());
            reason(&text.replacen(from, to, 1).chars().map(|c| c as u8).collect::<Vec<u8>>())
        };
        assert_eq!(
            replaced("\\\"version\\\":1", "\\\"version\\\":7"),
            "written in version 7 of the format; this engine reads version 1"
        );
        assert!(replaced("niwaki", "biwaki").contains("it has no entry `niwaki`"));
        assert!(replaced("windows\\\":5", "windows\\\":6").starts_with("`weights` is F32 of shape ["));
        assert!(replaced("\\\"values\\\":3", "\\\"values\\\":0").contains("cannot be"));
        let mut bytes = whole.clone();
        let end = bytes.len();
        bytes[end - 4..].copy_from_slice(&f32::NAN.to_le_bytes());
        assert!(reason(&bytes).ends_with("is NaN"));
    }
}
