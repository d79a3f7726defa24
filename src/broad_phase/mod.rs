//! Stub.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BroadPhase {
    #[default]
    AllPairs,
}
impl BroadPhase {
    pub(crate) fn checked(self) -> Result<(), crate::error::ConfigError> {
        Ok(())
    }
}
#[derive(Default)]
pub struct PairList {
    pairs: Vec<(u32, u32)>,
}
#[derive(Clone, Copy)]
pub struct Volume {
    pub moving: bool,
}
impl PairList {
    pub fn len(&self) -> usize {
        self.pairs.len()
    }
    pub fn iter(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.pairs.iter().copied()
    }
    pub fn update(
        &mut self,
        _b: BroadPhase,
        changed: &mut Vec<u32>,
        n: usize,
        f: impl Fn(u32) -> Option<Volume>,
    ) {
        if changed.is_empty() {
            return;
        }
        changed.clear();
        self.pairs.clear();
        for i in 0..n as u32 {
            for j in i + 1..n as u32 {
                let (Some(a), Some(b)) = (f(i), f(j)) else {
                    continue;
                };
                if a.moving {
                    self.pairs.push((i, j))
                } else if b.moving {
                    self.pairs.push((j, i))
                }
            }
        }
    }
}
