//! Surveys of a model's traces: the choices that a guide can draw, and the variables that it can see there.

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

/// A choice in the traces.
struct Choice {
    function: String,
    label: String,
    family: String,
    /// `None` if no head fits all of its distributions.
    head: Option<Head>,
    variables: Vec<usize>,
    parameters: usize,
    visits: u64,
}

/// A variable in the traces.
struct Variable {
    function: String,
    name: String,
    kind: Kind,
}

/// Collects the choices and variables of traces.
#[derive(Default)]
pub struct Survey {
    sites: Vec<(u128, Choice)>,
    numbers: HashMap<u128, usize>,
    variables: Vec<Variable>,
    by_name: HashMap<(String, String), usize>,
    /// Whether a choice without a frame in scope is inside a part.
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
            let choice = Choice {
                function: at.function.name.to_string(),
                label: at.site.label.to_string(),
                family: dist.family().name().to_string(),
                head: Head::of(dist, components),
                variables: Vec::new(),
                parameters: dist.numbers(&mut [0.0; MOST_NUMBERS]),
                visits: 0,
            };
            self.sites.push((at.site.key, choice));
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
            let known_kind = &mut self.variables[v].kind;
            if *known_kind != kind {
                *known_kind = std::mem::replace(known_kind, Kind::Nothing).join(kind);
            }
            if first {
                self.sites[number].1.variables.push(v);
            }
        }
        let choice = &mut self.sites[number].1;
        choice.visits += 1;
        choice.parameters = choice.parameters.min(dist.numbers(&mut [0.0; MOST_NUMBERS]));
        choice.head = choice.head.and_then(|head| head.widen(dist, components));
    }

    /// Choices of a program that are in no trace, by function and label.
    fn unvisited(&self, program: &Program) -> Vec<String> {
        let sites = program
            .functions
            .iter()
            .flat_map(|function| function.sites.iter().map(move |site| (function, site)));
        sites
            .filter(|(_, site)| {
                matches!(site.kind, SiteKind::Sample(_)) && !self.numbers.contains_key(&site.key)
            })
            .map(|(function, site)| format!("{}/{}", function.name, site.label))
            .collect()
    }

    /// The form of a guide for the choices of a program's traces.
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
        let unvisited = self.unvisited(program);
        let mut next = 0u32;
        let mut take = |count: usize| {
            let first = next;
            next += count as u32;
            first
        };
        let variables: Vec<VariableForm> = self
            .variables
            .into_iter()
            .map(|variable| VariableForm {
                first: take(variable.kind.len()),
                function: variable.function,
                name: variable.name,
                kind: variable.kind,
            })
            .collect();
        let part = self.parts.then(|| take(OF_PART.len()));
        let mut sites = Vec::new();
        let mut omitted: Vec<(String, String)> =
            unvisited.into_iter().map(|name| (name, "no trace visited it".into())).collect();
        for (key, choice) in self.sites {
            let Some(head) = choice.head else {
                let name = format!("{}/{}", choice.function, choice.label);
                omitted.push((name, format!("a guide draws no `{}` of this kind", choice.family)));
                continue;
            };
            let visible = choice.variables.iter().filter(|v| variables[**v].kind.len() > 0);
            sites.push(SiteForm {
                key: format!("{key:032x}"),
                function: choice.function,
                label: choice.label,
                family: choice.family,
                head,
                variables: visible.map(|v| *v as u32).collect(),
                parameters: (take(choice.parameters), choice.parameters as u32),
                visits: choice.visits,
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
            left: omitted,
            ahead: None,
            report: serde_json::Map::new(),
        })
    }
}
