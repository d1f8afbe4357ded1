//! Guides: small networks that draw choices in place of the prior (dissertation chapter 6).
//!
//! A guide replaces the parameters of a choice's distribution by the outputs of a network. It sees what is in scope at the
//! choice ([`inputs`]), the parameters of the prior, and a window of each sketch that shows one, around the current place
//! and in its direction ([`bound`]). It is a proposal: weights count prior over guide, so results stay right however
//! bad it is.
//!
//! - [`form`]: a guide as plain data;
//! - [`bound`]: a guide for one program, as a drawer of choices;
//! - [`ahead`]: the line of a guide that says what a paused run will still gain;
//! - [`images`]: what the dissertation's architecture sees, whole images.
//!
//! The networks are in `niwaki-guide`, the windows in `niwaki-geom`; training on the runs of a model is in `niwaki-search`.

pub mod ahead;
pub mod bound;
pub mod form;
pub mod images;
pub mod inputs;

use form::{FORMAT, GuideForm};
use niwaki_guide::{Filtered, Net};
use niwaki_vm::fault::Fault;

/// A trained guide.
#[derive(Debug)]
pub struct Guide {
    /// The inputs and the choices of the guide.
    pub form: GuideForm,
    /// Its network.
    pub net: Network,
}

/// The network of a guide.
#[derive(Clone, Debug)]
pub enum Network {
    /// One net for all choices, which sees windows.
    Shared(Net),
    /// The dissertation's: a net for each choice, which sees filtered images.
    Filtered(Filtered),
}

impl Network {
    /// How many weights it has.
    pub fn size(&self) -> usize {
        match self {
            Network::Shared(net) => net.size(),
            Network::Filtered(net) => net.size(),
        }
    }
}

/// The fault of a guide that cannot be used.
pub fn bad(message: String) -> Fault {
    Fault::new("bad-guide", message).with_help("train the guide again: `niwaki.train_guide`")
}

impl Guide {
    /// The guide as the bytes of a safetensors file.
    pub fn bytes(&self) -> Vec<u8> {
        let meta = serde_json::to_string(&self.form).unwrap_or_default();
        match &self.net {
            Network::Shared(net) => niwaki_guide::write(net, &meta),
            Network::Filtered(net) => niwaki_guide::write_filtered(net, &meta),
        }
    }

    /// The guide of such bytes.
    ///
    /// # Errors
    /// Bytes that are no guide, or one of a form that this version does not know.
    pub fn of_bytes(bytes: &[u8]) -> Result<Guide, Fault> {
        let unread = |error| bad(format!("this is no guide: {error}"));
        let (net, meta) = match niwaki_guide::read_filtered(bytes).map_err(unread)? {
            Some((net, meta)) => (Network::Filtered(net), meta),
            None => {
                niwaki_guide::read(bytes).map(|(net, meta)| (Network::Shared(net), meta)).map_err(unread)?
            }
        };
        let data: serde_json::Value =
            serde_json::from_str(&meta).map_err(|error| bad(format!("this is no guide: {error}")))?;
        let format = data["format"].as_u64().unwrap_or(0);
        if format != u64::from(FORMAT) {
            let message = format!("the guide has format {format}, this version reads {FORMAT}");
            return Err(bad(message));
        }
        let form: GuideForm =
            serde_json::from_value(data).map_err(|error| bad(format!("the guide's description: {error}")))?;
        let heads = form.sites.iter().map(|site| &site.head);
        let fits = match &net {
            Network::Shared(net) => {
                form.ahead.as_ref().is_none_or(|forecast| forecast.fits(net.form().hidden[1]))
                    && form.features() == net.form().features
                    && form.window_values() == net.form().windows
                    && form.image.is_none()
                    && heads.eq(&net.form().heads)
            }
            Network::Filtered(net) => {
                (form.features()..=form.features() + images::OF_PLACE as usize).contains(&net.form().features)
                    && form.image.is_some()
                    && form.ahead.is_none()
                    && heads.eq(&net.form().heads)
            }
        };
        if !fits {
            return Err(bad("the guide's description does not fit its network".into()));
        }
        Ok(Guide { form, net })
    }
}
