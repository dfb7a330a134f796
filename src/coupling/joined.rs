//! Things that are joined to others, by way of others (union-find).

/// Sets of numbers that are joined.
#[derive(Default)]
pub struct Joined {
    parents: Vec<usize>,
}

impl Joined {
    /// There are at least so many numbers; new ones are alone.
    pub fn grow(&mut self, count: usize) {
        self.parents.extend(self.parents.len()..count);
    }

    /// The smallest number of the set that a number is in.
    pub fn root(&mut self, mut index: usize) -> usize {
        while self.parents[index] != index {
            self.parents[index] = self.parents[self.parents[index]];
            index = self.parents[index];
        }
        index
    }

    /// Joins the sets of two numbers.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        // The smaller index is the root: no history decides.
        self.parents[a.max(b)] = a.min(b);
    }
}
