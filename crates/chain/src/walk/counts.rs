//! How often a chain proposed, and how often it accepted, by site of the program.

use niwaki_vm::code::{FunctionId, Program, SiteKind};
use serde::{Deserialize, Serialize};

/// Proposals at one site.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Count {
    /// How many there were.
    pub proposed: u64,
    /// How many were kept.
    pub accepted: u64,
    /// How many lay outside the support of the choice's distribution.
    pub outside: u64,
}

impl std::ops::AddAssign for Count {
    fn add_assign(&mut self, other: Count) {
        self.proposed += other.proposed;
        self.accepted += other.accepted;
        self.outside += other.outside;
    }
}

/// Proposals by site, and those of moves that change many choices.
#[derive(Clone, Debug)]
pub struct Counts {
    /// Number of a function's first site among all sites.
    first: Vec<u32>,
    /// By number of the site.
    pub sites: Vec<Count>,
    /// Blocks and regenerated calls.
    pub many: Count,
}

impl Counts {
    /// None yet.
    pub fn new(program: &Program) -> Counts {
        let (mut first, mut count) = (Vec::new(), 0);
        for f in &program.functions {
            first.push(count);
            count += f.sites.len() as u32;
        }
        Counts { first, sites: vec![Count::default(); count as usize], many: Count::default() }
    }

    /// All proposals together.
    pub fn all(&self) -> Count {
        let mut all = self.many;
        self.sites.iter().for_each(|site| all += *site);
        all
    }

    /// Number of a site.
    #[inline(always)]
    pub fn number(&self, (function, site): (FunctionId, u16)) -> usize {
        self.first[function.0 as usize] as usize + site as usize
    }

    /// The sites at which choices were proposed: function, readable component, line, counts.
    pub fn named(&self, program: &Program) -> Vec<(String, String, u32, Count)> {
        let mut rows = Vec::new();
        for (f, first) in program.functions.iter().zip(&self.first) {
            for (i, site) in f.sites.iter().enumerate() {
                let count = self.sites[*first as usize + i];
                if matches!(site.kind, SiteKind::Sample(_)) && count.proposed > 0 {
                    rows.push((f.name.to_string(), site.label.to_string(), site.span.line, count));
                }
            }
        }
        rows
    }
}
