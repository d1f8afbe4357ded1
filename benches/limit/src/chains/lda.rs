//! Topics of documents: a new topic visits its own words, a new share of topics the words of its document.
use super::{Groups, Model, SAME, Step, decide, draw, indices, simplex};
use crate::population::{Random, uniform};
use serde_json::Value;

pub struct Lda {
    topics: usize,
    vocabulary: usize,
    /// Words in each document.
    length: usize,
    documents: usize,
    words: Vec<u32>,
    /// `[topic * vocabulary + word]`.
    spoken: Vec<f64>,
    /// `[document * topics + topic]`.
    shares: Vec<f64>,
    z: Vec<u32>,
    groups: Groups,
    fresh: Vec<f64>,
}

impl Lda {
    pub fn new(data: &Value, random: &mut Random) -> Self {
        let size = |name: &str| data[name].as_u64().expect("a size") as usize;
        let (topics, vocabulary) = (size("topics"), size("vocabulary"));
        let documents: Vec<Vec<u32>> =
            data["documents"].as_array().expect("documents").iter().map(indices).collect();
        let length = documents[0].len();
        let mut made = Self {
            topics,
            vocabulary,
            length,
            documents: documents.len(),
            words: documents.concat(),
            spoken: vec![0.0; topics * vocabulary],
            shares: vec![0.0; documents.len() * topics],
            z: vec![],
            groups: Groups::new(topics),
            fresh: vec![0.0; vocabulary.max(topics)],
        };
        made.spoken.chunks_mut(vocabulary).for_each(|topic| simplex(random, topic));
        made.shares.chunks_mut(topics).for_each(|share| simplex(random, share));
        for i in 0..made.words.len() {
            let document = i / length;
            let topic = draw(random, &made.shares[document * topics..(document + 1) * topics]);
            made.z.push(topic as u32);
            made.groups.push(topic);
        }
        made
    }

    #[inline]
    fn word<const CHECKED: bool>(&mut self, i: usize, random: &mut Random, forced: bool) -> Step {
        let document = i / self.length;
        let share = &self.shares[document * self.topics..(document + 1) * self.topics];
        let (old, new) = (self.z[i] as usize, draw(random, share));
        if new == old {
            return SAME;
        }
        let word = self.words[i] as usize;
        let (there, here) =
            (self.spoken[new * self.vocabulary + word], self.spoken[old * self.vocabulary + word]);
        let accepted = forced || uniform(random) * here < there;
        let own_prior = if CHECKED { (share[new] / share[old]).ln() } else { 0.0 };
        if accepted {
            self.z[i] = new as u32;
            self.groups.relocate(i, old, new);
        }
        Step { accepted, log_ratio: if CHECKED { (there / here).ln() } else { 0.0 }, own_prior }
    }
}

impl Model for Lda {
    fn choices(&self) -> usize {
        self.topics + self.documents + self.words.len()
    }

    fn globals(&self) -> std::ops::Range<usize> {
        0..self.topics
    }

    fn readers(&self, choice: usize) -> usize {
        self.groups.members[choice].len()
    }

    #[inline]
    fn propose<const CHECKED: bool>(&mut self, choice: usize, random: &mut Random, forced: bool) -> Step {
        if choice >= self.topics + self.documents {
            return self.word::<CHECKED>(choice - self.topics - self.documents, random, forced);
        }
        if choice < self.topics {
            let topic = &mut self.spoken[choice * self.vocabulary..(choice + 1) * self.vocabulary];
            let fresh = &mut self.fresh[..topic.len()];
            simplex(random, fresh);
            let term = |&i: &u32| {
                let word = self.words[i as usize] as usize;
                (fresh[word] / topic[word]).ln()
            };
            let log_ratio = self.groups.members[choice].iter().map(term).sum();
            let accepted = decide(random, log_ratio, forced);
            if accepted {
                topic.copy_from_slice(fresh);
            }
            return Step { accepted, log_ratio, own_prior: 0.0 };
        }
        let document = choice - self.topics;
        let share = &mut self.shares[document * self.topics..(document + 1) * self.topics];
        let fresh = &mut self.fresh[..share.len()];
        simplex(random, fresh);
        // A product of twenty quotients cannot leave the range of a double in practice.
        let words = &self.z[document * self.length..(document + 1) * self.length];
        let ratio: f64 = words.iter().map(|&topic| fresh[topic as usize] / share[topic as usize]).product();
        let accepted = forced || uniform(random) < ratio;
        if accepted {
            share.copy_from_slice(fresh);
        }
        Step { accepted, log_ratio: if CHECKED { ratio.ln() } else { 0.0 }, own_prior: 0.0 }
    }

    // The flat Dirichlet priors are constant.
    fn log_joint(&self) -> f64 {
        let term = |i: usize| {
            let topic = self.z[i] as usize;
            let share = self.shares[i / self.length * self.topics + topic];
            share * self.spoken[topic * self.vocabulary + self.words[i] as usize]
        };
        (0..self.z.len()).map(|i| term(i).ln()).sum()
    }
}
