//! Calls of functions that can suspend: the code ends with one, after it has put the arguments into the registers of
//! the new activation. It leaves before a call that has to make room, or to pass shared data on.

use super::typed::Typed;
use super::write::{Cursor, PLAIN, Progress, Writer};
use crate::code::routine::{Dropping, Questions, Then};
use crate::code::{FunctionId, SiteId};
use niwaki_native::codegen::ir::condcodes::IntCC;
use niwaki_native::codegen::ir::types::I64;
use niwaki_native::codegen::ir::{InstBuilder, Value};
use std::mem::offset_of;

impl<'p: 'v, 'v> Writer<'p, 'v, '_> {
    /// Writes a call of a known function.
    pub(super) fn enter_call(
        &mut self,
        cursor: &Cursor<'v>,
        pc: usize,
        id: SiteId,
        function: FunctionId,
    ) -> Option<Progress> {
        let f = self.f(cursor);
        let site = &f.sites[usize::from(id.0)];
        let operands = f.operands[site.args.range()].iter();
        let arguments: Vec<Typed> =
            operands.map(|o| self.get(cursor, *o).map(|got| got.typed)).collect::<Option<_>>()?;
        if !arguments.iter().all(|typed| typed.number().is_some() || matches!(typed, Typed::None)) {
            return None;
        }
        let dropping = Dropping {
            registers: if site.is_tail { f.node_registers } else { 0 },
            may_hand_over: site.is_tail && function == cursor.function,
        };
        let call = self.question_address(cursor, pc, offset_of!(Questions, call));
        let words = [
            site.key as i64,
            (site.key >> 64) as i64,
            i64::from(function.0) << 32 | i64::from(id.0),
            dropping.word().cast_signed(),
        ];
        let args = [&[self.exchange], &words.map(|word| self.int(word))[..]].concat();
        let call = self.call_pointer(call, &args, Some(I64));
        let first = self.b.inst_results(call)[0];
        let none = self.b.ins().icmp_imm_s(IntCC::Equal, first, 0);
        self.leave_if(cursor, pc, none);
        self.store_arguments(first, &arguments);
        self.enter_activation(cursor, pc, site.is_tail);
        Some(Progress::Ended)
    }

    fn store_arguments(&mut self, first: Value, arguments: &[Typed]) {
        for (k, typed) in arguments.iter().enumerate() {
            let mark = self.int(typed.kind().mark().cast_signed());
            self.b.ins().store(PLAIN, mark, first, 16 * k as i32);
            if let Some(number) = typed.number() {
                self.b.ins().store(PLAIN, number.value(), first, 16 * k as i32 + 8);
            }
        }
    }

    /// Ends the code at a call whose activation exists. The registers of a caller that returns after it have no meaning
    /// any more.
    fn enter_activation(&mut self, cursor: &Cursor<'v>, pc: usize, is_tail: bool) {
        let mut cursor = cursor.clone();
        if is_tail {
            cursor.kinds.clear();
        }
        self.forget_dead(&mut cursor, pc + 1);
        cursor.count();
        self.end(&cursor, pc, Then::Enters);
    }

    /// Ends the code at an instruction.
    pub(super) fn end(&mut self, cursor: &Cursor<'v>, pc: usize, then: Then) {
        self.exit_here = None;
        let exit = self.exit(cursor, pc);
        self.exit_here = None;
        if let Some(pending) = self.pending_exits.last_mut() {
            pending.exit.then = then;
        }
        self.b.ins().jump(exit, &[]);
    }
}
