//! The bytes of a network, in the safetensors format. `weights` and `features` are as in the file of the other network; the form
//! has another name, so that neither is read as the other.

use super::form::FilteredForm;
use super::pass::Filtered;
use crate::net::{BadFile, read_form, read_numbers, write_as};

/// The name of the metadata's entry.
const ENTRY: &str = "niwaki-filtered";

/// The bytes of a network with a text of the caller.
pub fn write_filtered(net: &Filtered, text: &str) -> Vec<u8> {
    write_as(ENTRY, &net.form, text, &net.weights, &net.features)
}

/// The network and the text in some bytes; `None` if they hold another kind of network.
pub fn read_filtered(bytes: &[u8]) -> Result<Option<(Filtered, String)>, BadFile> {
    let Some((form, text)) = read_form::<FilteredForm>(ENTRY, bytes)? else { return Ok(None) };
    let sound = form.heads.iter().all(|head| head.is_sound())
        && form.sees.len() == form.heads.len()
        && form.heads.len() <= 1 << 14
        && form.features <= 1 << 14
        && form
            .sees
            .iter()
            .all(|sees| sees.len() <= form.features && sees.iter().all(|k| (*k as usize) < form.features));
    if !sound {
        return Err(BadFile::new("the description of the network contradicts itself".into()));
    }
    let layout = form.layout();
    let (weights, features) = read_numbers(bytes, layout.len, form.features)?;
    Ok(Some((Filtered { layout, form, weights, features, fresh: false }, text)))
}
