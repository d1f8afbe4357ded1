//! Lowering of expressions that suspend: each becomes one site of the function.
//!
//! A site's *key* is a hash of the function's qualified name, the called function or family, the assigned name,
//! and the occurrence among equals. Addresses, and so random streams, are built from keys. So an edited comment
//! or a moved line changes no random number.

use super::CompileError;
use super::emit::{Binding, Builder, Result};
use crate::code::{Args, Op, Operand, Place, Site, SiteId, SiteKind, Source, Visible};
use crate::core::{Expr, ExprKind, LOOK, Name, print, readable};
use crate::machine::address;
use niwaki_math::{Family, Scalar};

/// A family by its name in core form.
pub(crate) fn family(name: &str) -> Result<Family> {
    Family::from_name(name).ok_or_else(|| CompileError(format!("unknown distribution `{name}`")))
}

/// The last part of a qualified name, without the marks of nested functions.
pub(crate) fn short(name: &str) -> &str {
    let last = name.rsplit('.').next().unwrap_or(name);
    if last.starts_with("<lambda>") { "lambda" } else { last }
}

impl<S: Scalar> Builder<'_, '_, S> {
    /// Lowers the expression if it is a suspension site.
    pub fn site(&mut self, e: &Expr) -> Result<Option<Operand>> {
        use ExprKind::*;
        let target = self.target.clone();
        let choice_label = |family: &Name| match target.as_deref().map(readable) {
            None | Some("") => family.clone(),
            Some(name) => Name::from(name),
        };
        let fixed = |s: &str| Name::from(s);
        Ok(Some(match &e.kind {
            Call(f, args) if self.is_effectful(f) => {
                let (function, operands) = self.direct_call(f, args)?;
                self.add_site(SiteKind::Call { function }, f, (&e.label, short(f).into()), &operands)?
            }
            Apply(f, args) => {
                let mut operands = vec![self.expr(f)?];
                operands.extend(self.exprs(args)?);
                let label = self.callee(f);
                self.add_site(SiteKind::Apply, &fixed("apply"), (&e.label, label), &operands)?
            }
            Future(f, args) => {
                let (function, operands) = self.direct_call(f, args)?;
                let label = (&e.label, short(f).into());
                self.add_site(SiteKind::Future { function, detached: false }, f, label, &operands)?
            }
            FutureApply(f, args) => {
                let mut operands = vec![self.expr(f)?];
                operands.extend(self.exprs(args)?);
                let label = self.callee(f);
                self.add_site(
                    SiteKind::FutureApply { detached: false },
                    &fixed("future"),
                    (&e.label, label),
                    &operands,
                )?
            }
            Sample(d, options) => {
                let (kind, callee_name, mut operands) = self.distribution(d, true)?;
                if let Some(options) = options {
                    operands.push(self.expr(options)?);
                }
                let label = choice_label(&callee_name);
                let drawn = self.add_site(kind, &callee_name, (&e.label, label), &operands)?;
                if let Some(site) = self.sites.last_mut() {
                    site.has_options = options.is_some();
                }
                drawn
            }
            Observe(d, v) => {
                let (kind, callee_name, mut operands) = self.distribution(d, false)?;
                operands.push(self.expr(v)?);
                let callee_name = Name::from(format!("observe {callee_name}"));
                let score = self.add_site(kind, &callee_name, (&e.label, fixed("observe")), &operands)?;
                if let Some(site) = self.sites.last_mut() {
                    site.subject = address::site_key(&print::expression(v), 0);
                }
                score
            }
            Factor(x) => self.simple(SiteKind::Factor, "factor", &e.label, &[x])?,
            Condition(x) => self.simple(SiteKind::Condition, "condition", &e.label, &[x])?,
            Query(k, v) => self.simple(SiteKind::Query, "query", &e.label, &[k, v])?,
            Force(x) => self.simple(SiteKind::Force, "force", &e.label, &[x])?,
            Mem(f, None) => {
                let (operand, label) = (self.expr(f)?, target.as_deref().map_or("", readable));
                let label = Name::from(if label.is_empty() { "mem" } else { label });
                self.add_site(SiteKind::Memoise { of: None }, &fixed("mem"), (&e.label, label), &[operand])?
            }
            Mem(f, Some(name)) => {
                let operand = self.expr(f)?;
                let of = Some(address::join(address::ROOT, address::site_key(&format!("mem|{name}"), 0)));
                let label = (&Some(name.clone()), name.clone());
                self.add_site(SiteKind::Memoise { of }, name, label, &[operand])?
            }
            Emit(items) => {
                self.simple(SiteKind::Emit, "emit", &e.label, &items.iter().collect::<Vec<_>>())?
            }
            _ => return Ok(None),
        }))
    }

    fn simple(
        &mut self,
        kind: SiteKind,
        callee_name: &str,
        label: &Option<Name>,
        items: &[&Expr],
    ) -> Result<Operand> {
        let operands = items.iter().map(|e| self.expr(e)).collect::<Result<Vec<_>>>()?;
        self.add_site(kind, &Name::from(callee_name), (label, Name::from(callee_name)), &operands)
    }

    /// The name of a function value in an address: the variable that holds it, or the function itself.
    fn callee(&self, f: &Expr) -> Name {
        match &f.kind {
            ExprKind::Var(x) if !readable(x).is_empty() => Name::from(readable(x)),
            ExprKind::Closure(name, _) => short(name).into(),
            ExprKind::Field(_, name) => name.clone(),
            _ => Name::from("apply"),
        }
    }

    /// The site kind of a choice or an observation, together with its distribution if possible.
    fn distribution(&mut self, d: &Expr, sample: bool) -> Result<(SiteKind, Name, Vec<Operand>)> {
        let kind = if sample { SiteKind::Sample } else { SiteKind::Observe };
        match &d.kind {
            ExprKind::Dist(name, args) => {
                let family = family(name)?;
                let operands = self.exprs(args)?;
                if let Some(folded) = self.folded(d, &operands) {
                    let operand = self.constant(folded);
                    return Ok((kind(Source::Value), name.clone(), vec![operand]));
                }
                Ok((kind(Source::Family(family)), name.clone(), operands))
            }
            ExprKind::Op(op, parts)
                if &**op == "index" && parts.len() == 2 && !self.unit.collections.contains(d) =>
            {
                let operands = self.exprs(parts)?;
                Ok((kind(Source::Element), Name::from("dist"), operands))
            }
            _ => {
                let at = self.expr(d)?;
                Ok((kind(Source::Value), Name::from("dist"), vec![at]))
            }
        }
    }

    /// Lowers expressions that create or read elements of a collection, outside of pure functions.
    pub fn collection(&mut self, e: &Expr) -> Result<Option<Operand>> {
        if !self.unit.collections.contains(e) {
            return Ok(None);
        }
        match &e.kind {
            // Constants are used as elements directly.
            ExprKind::List(items) if items.iter().all(super::collections::is_constant) => Ok(None),
            ExprKind::List(items) => {
                let cells = items.iter().map(|item| self.cell(item)).collect::<Result<Vec<_>>>()?;
                let (to, args) = (self.register()?, self.args(&cells));
                self.op(Op::List { to, args });
                Ok(Some(to))
            }
            ExprKind::Op(name, parts) if &**name == "append" => {
                let list = self.expr(&parts[0])?;
                Ok(Some(self.append(list, &parts[1])?))
            }
            // `xs + [x]`
            ExprKind::Op(name, parts) if &**name == "add" => match &parts[1].kind {
                ExprKind::List(items) if items.len() == 1 => {
                    let list = self.expr(&parts[0])?;
                    Ok(Some(self.append(list, &items[0])?))
                }
                _ => Ok(None),
            },
            ExprKind::Op(_, parts) => {
                let operands = self.exprs(parts)?;
                let name = Name::from("[read]");
                Ok(Some(self.add_site(SiteKind::Read, &name, (&None, name.clone()), &operands)?))
            }
            _ => Ok(None),
        }
    }

    /// Lowers an append to a collection.
    fn append(&mut self, list: Operand, item: &Expr) -> Result<Operand> {
        let value = self.expr(item)?;
        let (name, content) = (Name::from("[cell]"), self.register()?);
        self.add_site(SiteKind::Append { content }, &name, (&None, name.clone()), &[list, value])
    }

    /// An element of a collection. Constants are used as elements directly.
    fn cell(&mut self, item: &Expr) -> Result<Operand> {
        let value = self.expr(item)?;
        if value.place() == Place::Constant {
            return Ok(value);
        }
        let (name, content) = (Name::from("[cell]"), self.register()?);
        self.add_site(SiteKind::Cell { content }, &name, (&None, name.clone()), &[value])
    }

    /// Adds a site, whose result has a register of its own. `label` is the label in the text, and the label
    /// from names for sites without one.
    pub fn add_site(
        &mut self,
        kind: SiteKind,
        callee_name: &Name,
        label: (&Option<Name>, Name),
        operands: &[Operand],
    ) -> Result<Operand> {
        // The number of a second variable with this name is left out: it depends on the text around the
        // function.
        let target = Name::from(self.target.as_deref().map_or("", readable));
        let args = if operands.is_empty() { Args::NONE } else { self.args(operands) };
        let to = self.register()?;
        let key = self.occurrence(&format!("{}|{callee_name}|{target}", self.name));
        let (text_label, named) = label;
        let repeated = self.occurrence(&format!("label {named}")).1;
        let from = self.scope.len() as u32;
        if matches!(kind, SiteKind::Sample(_)) {
            self.keep_scope();
        }
        let label = match (text_label, repeated) {
            (Some(text_label), _) => text_label.clone(),
            (None, 0) => named,
            (None, n) => Name::from(format!("{named}#{n}")),
        };
        let key = address::site_key(&key.0, key.1);
        self.sites.push(Site {
            kind,
            to,
            is_read: true,
            is_tail: false,
            args,
            has_options: false,
            key,
            label,
            span: self.span,
            next: 0,
            again: 0,
            is_angle: false,
            visible: (from, self.scope.len() as u32),
            subject: 0,
        });
        self.op(Op::Site { site: crate::code::SiteId((self.sites.len() - 1) as u16) });
        Ok(to)
    }

    /// Records the places of the variables that can be read at the next site.
    fn keep_scope(&mut self) {
        let site = SiteId(self.sites.len() as u16);
        let is_set = |(x, binding): &(&Name, &Binding)| !binding.maybe_unset || ***x == *LOOK;
        let mut set: Vec<(&Name, &Binding)> =
            self.env.iter().filter(|(x, _)| self.scope_of_choices.has(x)).filter(is_set).collect();
        set.sort_by_key(|(_, binding)| binding.moment);
        let visible = |(x, binding): (&Name, &Binding)| Visible {
            site,
            name: Name::from(readable(x)),
            at: binding.at,
            is_angle: false,
        };
        self.scope.extend(set.into_iter().map(visible));
    }

    /// The text, and the number of equal texts before it in this function.
    fn occurrence(&mut self, text: &str) -> (String, u32) {
        let count = self.occurrences.entry(text.to_string()).or_insert(0);
        *count += 1;
        (text.to_string(), *count - 1)
    }
}
