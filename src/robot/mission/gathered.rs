//! What the vehicle's senses found to differ, taken over when a goal is done with: for the next one, and to be remembered.

use crate::obstacle::is_obstacle;
use crate::reins::Reins;

use super::Mission;

impl Mission<'_> {
    /// Takes over all that the vehicle found to differ, whether it was in the way or not, for what follows.
    pub(super) fn gather(&mut self, reins: &Reins<'_>) {
        let gathered = reins.gathered();
        for seen in gathered.moved {
            self.belief.learn(seen);
        }
        for thing in gathered.missed {
            if is_obstacle(thing) {
                self.belief.lose(thing);
            } else {
                self.belief.miss(thing);
            }
        }
        for (thing, pieces) in self.belief.obstacles() {
            if reins.sees_through(&pieces) {
                self.belief.lose(thing);
            }
        }
        self.belief.stand_beside(&gathered.new);
    }
}
