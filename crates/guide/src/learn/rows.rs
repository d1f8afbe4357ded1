//! Rows: for each choice of some traces, a guide's inputs and the chosen value.

use crate::heads::{Known, Lesson};
use crate::net::NetForm;

/// Choices to learn from. A window that equals that of the choice before is stored once.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    windows: usize,
    features_of_form: usize,
    sites_of_form: usize,
    traces: usize,
    rows: Vec<Row>,
    /// All windows, one after the other.
    window_numbers: Vec<f32>,
    features: Vec<(u32, f32)>,
    numbers: Vec<f64>,
    /// Whether the next window belongs to another trace.
    apart: bool,
}

/// A choice: the places where its parts begin.
#[derive(Clone, Copy, Debug)]
struct Row {
    site: u32,
    window: u32,
    features: (usize, u32),
    numbers: usize,
    kind: Kind,
}

/// The kind of the lesson in the numbers.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Normal,
    Finite { value: u32, values: u32 },
    Count,
}

impl Rows {
    /// An empty list of rows, for networks of this form.
    pub fn new(form: &NetForm) -> Rows {
        Rows {
            windows: form.windows,
            features_of_form: form.features,
            sites_of_form: form.heads.len(),
            ..Rows::default()
        }
    }

    /// Begins the choices of another trace.
    pub fn trace(&mut self) {
        self.traces += 1;
        self.apart = true;
    }

    /// Adds a choice: its site, the numbers of its window, its features as (number, raw value), and the lesson.
    ///
    /// # Panics
    ///
    /// If a number does not belong to the form.
    pub fn push(&mut self, site: usize, window: &[f32], features: &[(u32, f32)], lesson: &Lesson) {
        assert_eq!(window.len(), self.windows, "numbers of a window");
        assert!(site < self.sites_of_form, "no site {site}");
        assert!(features.iter().all(|(k, _)| (*k as usize) < self.features_of_form), "a feature's number");
        let is_repeated = !self.apart && self.rows.last().is_some_and(|last| self.window_of(*last) == window);
        if !is_repeated {
            self.window_numbers.extend_from_slice(window);
        }
        self.apart = false;
        let window = self.window_numbers.len().checked_div(self.windows).map_or(0, |n| n - 1);
        let (at, numbers) = (self.features.len(), self.numbers.len());
        self.features.extend_from_slice(features);
        let kind = match lesson {
            Lesson::Normal { z, log_prior, limits } => {
                self.numbers.extend([*z, *log_prior, limits.0, limits.1]);
                Kind::Normal
            }
            Lesson::Finite { value, log_priors } => {
                self.numbers.extend_from_slice(log_priors);
                Kind::Finite { value: small(*value), values: small(log_priors.len()) }
            }
            Lesson::Count { between, log_prior } => {
                self.numbers.extend([between.0, between.1, *log_prior]);
                Kind::Count
            }
        };
        self.rows.push(Row {
            site: small(site),
            window: small(window),
            features: (at, small(features.len())),
            numbers,
            kind,
        });
    }

    /// Adds the rows of other traces, for networks of this form.
    pub fn append(&mut self, other: &Rows) {
        let windows = small(self.window_numbers.len().checked_div(self.windows).unwrap_or(0));
        let (features, numbers) = (self.features.len(), self.numbers.len());
        self.rows.extend(other.rows.iter().map(|row| Row {
            window: row.window + windows,
            features: (row.features.0 + features, row.features.1),
            numbers: row.numbers + numbers,
            ..*row
        }));
        self.window_numbers.extend_from_slice(&other.window_numbers);
        self.features.extend_from_slice(&other.features);
        self.numbers.extend_from_slice(&other.numbers);
        self.traces += other.traces;
        self.apart = true;
    }

    /// The number of choices.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no choices.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The number of traces.
    pub fn traces(&self) -> usize {
        self.traces
    }

    /// Bytes of memory that the rows take.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
            + size_of_val(&*self.window_numbers)
            + size_of_val(&*self.features)
            + size_of_val(&*self.numbers)
    }

    /// The stored windows.
    pub(crate) fn all_windows(&self) -> impl Iterator<Item = &[f32]> {
        self.window_numbers.chunks_exact(self.windows.max(1))
    }

    /// Features of all rows.
    pub(crate) fn all_features(&self) -> &[(u32, f32)] {
        &self.features
    }

    /// The site of a row.
    pub(crate) fn site(&self, row: usize) -> usize {
        self.rows[row].site as usize
    }

    /// The window of a row.
    pub(crate) fn window(&self, row: usize) -> &[f32] {
        self.window_of(self.rows[row])
    }

    fn window_of(&self, row: Row) -> &[f32] {
        let start = row.window as usize * self.windows;
        &self.window_numbers[start..start + self.windows]
    }

    /// The features of a row.
    pub(crate) fn features(&self, row: usize) -> &[(u32, f32)] {
        let (start, count) = self.rows[row].features;
        &self.features[start..start + count as usize]
    }

    /// The lesson of a row.
    pub(crate) fn lesson(&self, row: usize) -> Known<'_> {
        let Row { numbers, kind, .. } = self.rows[row];
        let n = &self.numbers[numbers..];
        match kind {
            Kind::Normal => Known::normal(n[0], n[1], (n[2], n[3])),
            Kind::Finite { value, values } => {
                Known::Finite { value: value as usize, log_priors: &n[..values as usize] }
            }
            Kind::Count => Known::Count { between: (n[0], n[1]), log_prior: n[2] },
        }
    }
}

/// A count of rows, windows or features as 32 bits, the size in a row: 2^32 of them would take 16 GB or more.
fn small(n: usize) -> u32 {
    u32::try_from(n).expect("fewer than 2^32 rows")
}

#[cfg(test)]
mod tests {
    //! Choices are stored unchanged, and equal windows once.
    use super::*;
    use crate::heads::Head;

    #[test]
    fn rows_keep_their_choices() {
        let heads = vec![Head::Finite { values: 2 }, Head::Normal { components: 2 }];
        let mut rows = Rows::new(&NetForm::new(2, 3, heads));
        let coin = Lesson::Finite { value: 1, log_priors: [-0.5, -1.0].into() };
        let bell = Lesson::Normal { z: 0.3, log_prior: -1.0, limits: (-7.5, 7.5) };
        rows.trace();
        rows.push(0, &[0.1, 0.2], &[(2, 5.0)], &coin);
        rows.push(1, &[0.1, 0.2], &[], &bell);
        rows.push(1, &[0.3, 0.2], &[(0, 1.0), (1, 2.0)], &bell);
        rows.trace();
        rows.push(0, &[0.3, 0.2], &[], &coin);
        assert_eq!((rows.len(), rows.traces(), rows.all_windows().count()), (4, 2, 3));
        assert_eq!(rows.window(1), [0.1, 0.2]);
        assert_eq!(rows.window(3), [0.3, 0.2]);
        assert_eq!((rows.site(2), rows.features(2)), (1, &[(0, 1.0), (1, 2.0)][..]));
        assert!(matches!(rows.lesson(0), Known::Finite { value: 1, log_priors: [-0.5, -1.0] }));
        assert!(matches!(rows.lesson(2), Known::Normal(place) if place.z == 0.3));
    }
}
