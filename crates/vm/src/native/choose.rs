//! Choices and factors in machine code: the family, the registers of its parameters and the key of the site are known, and only the
//! draw itself is a call, of a question of the [`Exchange`]. Nothing has happened yet where the code leaves
//! before a choice, so the interpreter asks then: without questions, for parameters that the family refuses, and
//! for every family whose draws are not single numbers.

use super::typed::Typed;
use super::write::{Cursor, PLAIN, Progress, Writer};
use crate::code::register::Kind;
use crate::code::routine::{Exchange, Questions, Then};
use crate::code::{Operand, Site, SiteId, SiteKind, Source};
use crate::value::Value as Model;
use niwaki_math::{Dist, Family};
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::{F64, I64};
use niwaki_native::codegen::ir::{InstBuilder, Value};
use std::mem::offset_of;

/// Whether there is machine code for a site, if its parameters are of the right kinds.
pub(super) fn may_choose(site: &Site) -> bool {
    match site.kind {
        SiteKind::Sample(Source::Family(family)) => of_numbers(family).is_some(),
        SiteKind::Sample(Source::Value) => true,
        _ => false,
    }
}

/// The place of the question for a family in [`Questions`], for families with a question of their own.
fn of_numbers(family: Family) -> Option<usize> {
    match family {
        Family::Gaussian => Some(offset_of!(Questions, gaussian)),
        Family::Uniform => Some(offset_of!(Questions, uniform)),
        Family::Bernoulli => Some(offset_of!(Questions, bernoulli)),
        _ => None,
    }
}

/// The kind of the draws of a family; `None` if they are not single numbers.
pub(crate) fn kind_of_draws(family: Family) -> Option<Kind> {
    match family {
        Family::Bernoulli => Some(Kind::Bool),
        Family::Categorical | Family::DiscreteUniform | Family::Poisson => Some(Kind::Int),
        Family::Binomial | Family::Geometric => Some(Kind::Int),
        Family::Uniform | Family::Gaussian | Family::LogNormal | Family::Gamma => Some(Kind::Real),
        Family::InverseGamma | Family::Beta | Family::Exponential | Family::Laplace => Some(Kind::Real),
        Family::Cauchy | Family::StudentT | Family::VonMises => Some(Kind::Real),
        Family::TruncatedGaussian => Some(Kind::Real),
        Family::Dirichlet | Family::MultivariateGaussian | Family::DiagonalGaussian => None,
        Family::Multinomial | Family::MultivariateBernoulli | Family::Mixture | Family::Delta => None,
    }
}

/// A question: its place in [`Questions`], its two parameters, and the kind of the answer.
type Question = (usize, [Value; 2], Kind);

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Writes a choice or a factor.
    pub(super) fn ask(&mut self, cursor: &mut Cursor<'v>, pc: usize, id: SiteId) -> Option<Progress> {
        let site = &self.f(cursor).sites[usize::from(id.0)];
        match site.kind {
            SiteKind::Sample(_) => self.choose(cursor, pc, site),
            SiteKind::Factor => self.factor(cursor, pc, site),
            SiteKind::Call { function } => self.enter_call(cursor, pc, id, function),
            _ => None,
        }
    }

    fn choose(&mut self, cursor: &mut Cursor<'v>, pc: usize, site: &Site) -> Option<Progress> {
        let (at, parameters, kind) = self.question(cursor, site)?;
        let address = self.question_address(cursor, pc, at);
        cursor.asks = true;
        let halves = [site.key as i64, (site.key >> 64) as i64].map(|half| self.int(half));
        let args = [&[self.exchange], &halves[..], &parameters[..]].concat();
        let call = self.call_pointer(address, &args, Some(I64));
        let mark = self.b.inst_results(call)[0];
        let other = self.b.ins().icmp_imm_s(IntCC::NotEqual, mark, kind.mark().cast_signed());
        self.leave_if(cursor, pc, other);
        self.take_logged();
        let at = offset_of!(Exchange, answer) as i32;
        let typed = match kind {
            Kind::Real => Typed::Real(self.b.ins().load(F64, PLAIN, self.exchange, at)),
            Kind::Int => Typed::Int(self.load_exchange(at)),
            _ => Typed::Bool(self.load_exchange(at)),
        };
        self.put(cursor, site.to, typed, None);
        Some(Progress::Next)
    }

    /// Writes a factor. The code ends after it, because most runs pause there.
    fn factor(&mut self, cursor: &Cursor<'v>, pc: usize, site: &Site) -> Option<Progress> {
        let log = *self.f(cursor).operands[site.args.range()].last()?;
        let log = self.parameter(cursor, log)?;
        let score = self.question_address(cursor, pc, offset_of!(Questions, score));
        self.leave_unless_finite(cursor, pc, log);
        self.call_pointer(score, &[self.exchange, log], None);
        let mut after = cursor.clone();
        after.count();
        self.end(&after, pc + 1, Then::Pauses);
        Some(Progress::Ended)
    }

    /// The address of a question; leaves if the code may not ask.
    pub(super) fn question_address(&mut self, cursor: &Cursor<'v>, pc: usize, at: usize) -> Value {
        let questions = self.leave_unless_asking(cursor, pc);
        self.b.ins().load(I64, PLAIN, questions, at as i32)
    }

    /// Leaves before the instruction if the code may not ask. Returns the address of the questions.
    pub(super) fn leave_unless_asking(&mut self, cursor: &Cursor<'v>, pc: usize) -> Value {
        let questions = self.load_exchange(offset_of!(Exchange, questions) as i32);
        let none = self.b.ins().icmp_imm_s(IntCC::Equal, questions, 0);
        self.leave_if(cursor, pc, none);
        questions
    }

    /// Leaves as many bytes less as the log takes for a choice. The machine counts them.
    fn take_logged(&mut self) {
        let logged = self.load_exchange(offset_of!(Exchange, logged) as i32);
        let left = self.b.use_var(self.bytes);
        let left = self.b.ins().isub(left, logged);
        self.b.def_var(self.bytes, left);
    }

    /// The question of a choice; `None` if the interpreter has to ask.
    fn question(&mut self, cursor: &Cursor<'v>, site: &Site) -> Option<Question> {
        let parameters = &self.f(cursor).operands[site.parameters().range()];
        match (&site.kind, parameters) {
            (SiteKind::Sample(Source::Family(family)), parameters) => {
                let numbers = parameters.iter().map(|o| self.parameter(cursor, *o));
                let numbers: Vec<Value> = numbers.collect::<Option<_>>()?;
                self.question_of(*family, &numbers)
            }
            (SiteKind::Sample(Source::Value), [value]) => self.question_of_value(cursor, *value),
            _ => None,
        }
    }

    fn question_of(&mut self, family: Family, numbers: &[Value]) -> Option<Question> {
        let parameters = match *numbers {
            [a] if family == Family::Bernoulli => [a, a],
            [a, b] if family != Family::Bernoulli => [a, b],
            _ => return None,
        };
        Some((of_numbers(family)?, parameters, kind_of_draws(family)?))
    }

    /// The question of a choice from a distribution in a register or a constant.
    fn question_of_value(&mut self, cursor: &Cursor<'v>, o: Operand) -> Option<Question> {
        let operand = self.get(cursor, o)?;
        let (Typed::Object(object, _), Some(Model::Dist(dist))) = (operand.typed, operand.sample) else {
            return None;
        };
        let numbers: &[f64] = match **dist {
            Dist::Gaussian { mean, sd } => &[mean, sd],
            Dist::Uniform { lo, hi } => &[lo, hi],
            Dist::Bernoulli { p } => &[p],
            _ => &[],
        };
        if o.is_constant() && !numbers.is_empty() {
            let numbers: Vec<Value> = numbers.iter().map(|x| self.b.ins().f64const(*x)).collect();
            return self.question_of(dist.family(), &numbers);
        }
        let kind = kind_of_draws(dist.family())?;
        let mark = self.int(kind.mark().cast_signed());
        Some((offset_of!(Questions, held), [object, mark], kind))
    }

    /// A parameter as a real number.
    fn parameter(&mut self, cursor: &Cursor<'v>, o: Operand) -> Option<Value> {
        let typed = self.get(cursor, o)?.typed;
        self.real(typed)
    }
}
