//! The two sides of a piece of a face: whether a solid is there, where that is known.
//!
//! A piece that no other face crosses has the solid, or not, right before it and right behind it. Operations on solids are logic
//! on each side alone. So faces that lie on one another need no rules of their own: a piece is on the surface of the result
//! if its sides differ.

/// The known sides of a piece. Bit 0 is the front, where the normal points, and bit 1 the back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sides {
    known: u8,
    solid: u8,
}

impl Sides {
    /// Nothing is known.
    pub const UNKNOWN: Sides = Sides { known: 0, solid: 0 };
    /// Outside of the solid.
    pub const OUT: Sides = Sides { known: 3, solid: 0 };
    /// Inside of the solid.
    pub const IN: Sides = Sides { known: 3, solid: 3 };
    /// On a face of the solid that looks the same way.
    pub const ON: Sides = Sides { known: 3, solid: 2 };
    /// On a face of the solid that looks the other way.
    pub const AGAINST: Sides = Sides { known: 3, solid: 1 };

    /// True on a face of the solid.
    pub fn is_on(self) -> bool {
        self == Sides::ON || self == Sides::AGAINST
    }

    /// True if both sides are known.
    pub fn is_known(self) -> bool {
        self.known == 3
    }

    /// True if the solid is right before the piece.
    pub fn front(self) -> bool {
        self.solid & 1 == 1
    }

    /// Where neither is there, and where one is missing, both together are missing.
    pub fn and(self, other: Sides) -> Sides {
        let missing = (self.known & !self.solid) | (other.known & !other.solid);
        Sides { known: (self.known & other.known) | missing, solid: self.solid & other.solid }
    }

    /// Where one is there, one of both is.
    pub fn or(self, other: Sides) -> Sides {
        let solid = self.solid | other.solid;
        Sides { known: (self.known & other.known) | solid, solid }
    }

    /// Where it is missing.
    pub fn not(self) -> Sides {
        Sides { known: self.known, solid: self.known & !self.solid }
    }
}

#[cfg(test)]
mod tests {
    //! The claim: what is said to be known holds for every value of what is not known.
    use super::Sides;

    #[test]
    fn known_sides_hold_whatever_the_others_are() {
        let whole = [Sides::OUT, Sides::IN, Sides::ON, Sides::AGAINST];
        let partial: Vec<Sides> =
            (0..4).flat_map(|known| (0..4).map(move |solid| Sides { known, solid: solid & known })).collect();
        let fits = |part: &Sides, all: &Sides| all.solid & part.known == part.solid;
        for a in &partial {
            for b in &partial {
                for (x, y) in whole.iter().flat_map(|x| whole.iter().map(move |y| (x, y))) {
                    if fits(a, x) && fits(b, y) {
                        assert_eq!((x.and(*y).solid, x.or(*y).solid), (x.solid & y.solid, x.solid | y.solid));
                        assert!(fits(&a.and(*b), &x.and(*y)) && fits(&a.or(*b), &x.or(*y)));
                        assert!(fits(&a.not(), &x.not()));
                    }
                }
            }
        }
        assert!(Sides::OUT.and(Sides::UNKNOWN).is_known() && Sides::IN.or(Sides::UNKNOWN).is_known());
        assert_eq!(Sides::ON.and(Sides::ON.not()), Sides::OUT);
    }
}
