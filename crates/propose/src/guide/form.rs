//! A guide as plain data: what its file says beside the weights of the network.

use super::ahead::AheadForm;
use super::bound::OF_PART;
use super::inputs::Kind;
use niwaki_geom::WindowForm;
use niwaki_guide::Head;
use serde::{Deserialize, Serialize};

/// The version of the file's form.
pub const FORMAT: u32 = 1;

/// The inputs of a guide, and the choices that it draws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GuideForm {
    /// The version of this form.
    pub format: u32,
    /// The version of the package that made it.
    pub version: String,
    /// The name of the model that it was made for.
    pub model: String,
    /// The share of the prior in each proposal.
    pub share: f64,
    /// Windows: the name of the sketch that shows one, in the order of the score, and its points.
    pub windows: Vec<(String, WindowForm)>,
    /// The page that it looks at: only of the dissertation's architecture, which has no windows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageForm>,
    /// The variables that it reads.
    pub variables: Vec<VariableForm>,
    /// The number of the first input of the last part on the call path; `None` where it does not read it.
    #[serde(default)]
    pub part: Option<u32>,
    /// The choices that it draws, in the order of the network's heads.
    pub sites: Vec<SiteForm>,
    /// Choices that were met and are left to their priors, with the reason.
    pub left: Vec<(String, String)>,
    /// How it looks ahead; `None` where it has not learned to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ahead: Option<AheadForm>,
    /// The training data and the quality of the guide, for people.
    pub report: serde_json::Map<String, serde_json::Value>,
}

/// A page that a guide looks at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageForm {
    /// The name of the sketch that draws on it.
    pub sketch: String,
}

/// A variable in scope at choices of its function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariableForm {
    /// The function's qualified name.
    pub function: String,
    /// The variable's name in the source.
    pub name: String,
    /// How its value becomes numbers.
    pub kind: Kind,
    /// The number of its first input.
    pub first: u32,
}

/// A choice that a guide draws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SiteForm {
    /// The key of the site, hexadecimal.
    pub key: String,
    /// The function's qualified name.
    pub function: String,
    /// The choice's name in addresses.
    pub label: String,
    /// The family of its prior.
    pub family: String,
    /// The meaning of the network's outputs.
    pub head: Head,
    /// The variables that it sees, by number.
    pub variables: Vec<u32>,
    /// The number of the input of the prior's first parameter, and how many parameters there are.
    pub parameters: (u32, u32),
    /// How often it was met in the traces.
    pub visits: u64,
}

impl GuideForm {
    /// The form of a guide whose network will change: it has to learn to look ahead again.
    pub fn to_train(&self) -> GuideForm {
        GuideForm { ahead: None, ..self.clone() }
    }

    /// How many inputs there are beside the windows.
    pub fn features(&self) -> usize {
        let of_variables =
            self.variables.iter().map(|variable| variable.first as usize + variable.kind.len());
        let of_sites = self.sites.iter().map(|site| site.parameters.0 as usize + site.parameters.1 as usize);
        let of_part = self.part.map(|first| first as usize + OF_PART.len());
        of_variables.chain(of_sites).chain(of_part).max().unwrap_or(0)
    }

    /// How many numbers the windows have.
    pub fn window_values(&self) -> usize {
        self.windows.iter().map(|(_, form)| form.values()).sum()
    }

    /// The guide reads only the variables of these names, not the last part, and no parameters of priors.
    pub fn keep_only(&mut self, names: &[String]) {
        let kept = |v: &VariableForm| names.contains(&v.name);
        let (mut numbers, mut next, mut first) = (Vec::new(), 0, 0);
        for variable in &mut self.variables {
            numbers.push(kept(variable).then_some(next));
            if kept(variable) {
                variable.first = first;
                (next, first) = (next + 1, first + variable.kind.len() as u32);
            }
        }
        self.variables.retain(kept);
        self.part = None;
        for site in &mut self.sites {
            site.variables = site.variables.iter().filter_map(|v| numbers[*v as usize]).collect();
            site.parameters = (0, 0);
        }
    }

    /// Names of the inputs beside the windows, by number.
    pub fn names(&self) -> Vec<String> {
        let mut names = vec![String::new(); self.features()];
        let mut put = |first: u32, part: Vec<String>| {
            part.into_iter().enumerate().for_each(|(i, name)| names[first as usize + i] = name);
        };
        for variable in &self.variables {
            let mut parts = Vec::new();
            variable.kind.names(&format!("{}:{}", variable.function, variable.name), &mut parts);
            put(variable.first, parts);
        }
        if let Some(first) = self.part {
            put(first, OF_PART.iter().map(|name| format!("the last part: {name}")).collect());
        }
        for site in &self.sites {
            let name = |i| format!("{}/{}: parameter {} of the prior", site.function, site.label, i + 1);
            put(site.parameters.0, (0..site.parameters.1).map(name).collect());
        }
        names
    }
}
