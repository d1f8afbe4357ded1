//! Counts of the proposals and acceptances of a chain, by site of the program.

use niwaki_vm::code::{FunctionId, Program, SiteKind};
use serde::{Deserialize, Serialize};

/// Counts of the proposals at a site.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Count {
    /// The number of proposals.
    pub proposed: u64,
    /// The number of accepted proposals.
    pub accepted: u64,
    /// The number of proposals outside the support of the prior.
    pub outside: u64,
}

impl std::ops::AddAssign for Count {
    fn add_assign(&mut self, other: Count) {
        self.proposed += other.proposed;
        self.accepted += other.accepted;
        self.outside += other.outside;
    }
}

/// Counts by site, and counts of moves that change many choices.
#[derive(Clone, Debug)]
pub struct Counts {
    /// The number of the first site of each function among all sites.
    first: Vec<u32>,
    /// Counts by number of the site.
    pub sites: Vec<Count>,
    /// Counts of blocks and regenerated calls.
    pub many: Count,
}

impl Counts {
    /// Start with zero counts.
    pub fn new(program: &Program) -> Counts {
        let (mut first, mut count) = (Vec::new(), 0);
        for f in &program.functions {
            first.push(count);
            count += f.sites.len() as u32;
        }
        Counts { first, sites: vec![Count::default(); count as usize], many: Count::default() }
    }

    /// The sum of all counts.
    pub fn all(&self) -> Count {
        let mut all = self.many;
        self.sites.iter().for_each(|site| all += *site);
        all
    }

    /// The number of a site among all sites.
    #[inline(always)]
    pub fn number(&self, (function, site): (FunctionId, u16)) -> usize {
        self.first[function.0 as usize] as usize + site as usize
    }

    /// The sites with proposals: function, readable component, line, counts.
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
