//! What the traces of a model show: which choices a guide can draw, and what it can see there.

use super::lessons::{Example, follow};
use niwaki_geom::WindowForm;
use niwaki_guide::Head;
use niwaki_math::{Dist, MOST_NUMBERS};
use niwaki_propose::guide::bound::OF_PART;
use niwaki_propose::guide::form::{FORMAT, GuideForm, SiteForm, VariableForm};
use niwaki_propose::guide::inputs::Kind;
use niwaki_run::Failure;
use niwaki_vm::code::{Program, SiteKind};
use niwaki_vm::fault::Fault;
use niwaki_vm::machine::answers::At;
use std::collections::HashMap;

/// A choice as it was met.
struct Met {
    function: String,
    label: String,
    family: String,
    /// `None` where no head fits all of its distributions.
    head: Option<Head>,
    variables: Vec<usize>,
    parameters: usize,
    visits: u64,
}

/// A variable as it was met.
struct Variable {
    function: String,
    name: String,
    kind: Kind,
}

/// Collects what traces show.
#[derive(Default)]
pub struct Survey {
    sites: Vec<(u128, Met)>,
    numbers: HashMap<u128, usize>,
    variables: Vec<Variable>,
    by_name: HashMap<(String, String), usize>,
    /// Whether a choice without a frame in scope met a part.
    parts: bool,
}

impl Survey {
    /// Adds the choices of a trace.
    ///
    /// # Errors
    /// A trace that cannot be followed.
    pub fn add(&mut self, example: &Example, components: usize) -> Result<(), Failure> {
        follow(example, &mut |at, dist, _, _| {
            self.meet(at, dist, components);
            Ok(())
        })
    }

    fn meet(&mut self, at: &At<'_, f64>, dist: &Dist, components: usize) {
        if matches!(dist, Dist::Delta(_)) {
            return;
        }
        let number = *self.numbers.entry(at.site.key).or_insert_with(|| {
            let met = Met {
                function: at.function.name.to_string(),
                label: at.site.label.to_string(),
                family: dist.family().name().to_string(),
                head: Head::of(dist, components),
                variables: Vec::new(),
                parameters: dist.numbers(&mut [0.0; MOST_NUMBERS]),
                visits: 0,
            };
            self.sites.push((at.site.key, met));
            self.sites.len() - 1
        });
        self.parts |= at.part().is_some() && at.look().is_none();
        let first = self.sites[number].1.visits == 0;
        for (name, is_angle, value) in at.visible() {
            let key = (at.function.name.to_string(), name.to_string());
            let kind = Kind::of(value, is_angle);
            let v = match self.by_name.get(&key) {
                Some(v) => *v,
                None => {
                    self.variables.push(Variable {
                        function: key.0.clone(),
                        name: key.1.clone(),
                        kind: kind.clone(),
                    });
                    self.by_name.insert(key, self.variables.len() - 1);
                    self.variables.len() - 1
                }
            };
            let own = &mut self.variables[v].kind;
            if *own != kind {
                *own = std::mem::replace(own, Kind::Nothing).join(kind);
            }
            if first {
                self.sites[number].1.variables.push(v);
            }
        }
        let met = &mut self.sites[number].1;
        met.visits += 1;
        met.parameters = met.parameters.min(dist.numbers(&mut [0.0; MOST_NUMBERS]));
        met.head = met.head.and_then(|head| head.widen(dist, components));
    }

    /// Choices of a program that were not met, by function and label.
    fn unmet(&self, program: &Program) -> Vec<String> {
        let sites = program.functions.iter().flat_map(|own| own.sites.iter().map(move |site| (own, site)));
        sites
            .filter(|(_, site)| {
                matches!(site.kind, SiteKind::Sample(_)) && !self.numbers.contains_key(&site.key)
            })
            .map(|(own, site)| format!("{}/{}", own.name, site.label))
            .collect()
    }

    /// The form of a guide for what was met of a program.
    ///
    /// # Errors
    /// Traces without a choice that a guide can draw.
    pub fn form(
        self,
        program: &Program,
        model: &str,
        share: f64,
        windows: Vec<(String, WindowForm)>,
    ) -> Result<GuideForm, Fault> {
        let unmet = self.unmet(program);
        let mut next = 0u32;
        let mut take = |count: usize| {
            let first = next;
            next += count as u32;
            first
        };
        let variables: Vec<VariableForm> = self
            .variables
            .into_iter()
            .map(|own| VariableForm {
                first: take(own.kind.len()),
                function: own.function,
                name: own.name,
                kind: own.kind,
            })
            .collect();
        let part = self.parts.then(|| take(OF_PART.len()));
        let mut sites = Vec::new();
        let mut left: Vec<(String, String)> =
            unmet.into_iter().map(|name| (name, "no trace visited it".into())).collect();
        for (key, met) in self.sites {
            let Some(head) = met.head else {
                let name = format!("{}/{}", met.function, met.label);
                left.push((name, format!("a guide draws no `{}` of this kind", met.family)));
                continue;
            };
            let seen = met.variables.iter().filter(|v| variables[**v].kind.len() > 0);
            sites.push(SiteForm {
                key: format!("{key:032x}"),
                function: met.function,
                label: met.label,
                family: met.family,
                head,
                variables: seen.map(|v| *v as u32).collect(),
                parameters: (take(met.parameters), met.parameters as u32),
                visits: met.visits,
            });
        }
        if sites.is_empty() {
            return Err(Fault::new("guide-traces", "the traces have no choice that a guide can draw")
                .with_help("give traces of a model that makes choices of numbers or truth values"));
        }
        Ok(GuideForm {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_string(),
            model: model.to_string(),
            share,
            windows,
            image: None,
            variables,
            part,
            sites,
            left,
            ahead: None,
            report: serde_json::Map::new(),
        })
    }
}
