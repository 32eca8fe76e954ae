//! A store that several programs write in turn: who lives long has it for the length of a call.
//!
//! A call that writes takes it up and puts it down; one that asks takes over what others wrote. What follows from the map
//! follows their edits as it does those of this program.

use crate::store::{Meanwhile, Store, StoreError};

use super::{Engine, Error};

impl Engine {
    /// Takes the store for this program alone, with what other programs wrote since; whether they did. Where another program
    /// keeps it for longer than a call takes, or drives the robot, it is left there: what would write says so
    /// ([`StoreError::Locked`]), and what is asked is answered. Without a store, or in one that is only read, nothing is
    /// taken.
    ///
    /// # Errors
    /// As [`Engine::open`].
    pub fn take_up(&mut self) -> Result<bool, Error> {
        match self.with_what_others_wrote(Store::take_up) {
            Err(Error::Store(StoreError::Locked { .. })) => self.catch_up(),
            taken => taken,
        }
    }

    /// Takes over what other programs wrote, and leaves the store to them; whether they did.
    ///
    /// # Errors
    /// As [`Engine::open_read_only`].
    pub fn catch_up(&mut self) -> Result<bool, Error> {
        self.with_what_others_wrote(Store::follow)
    }

    /// Lets other programs write until the store is taken up again.
    pub fn put_down(&mut self) {
        if let Some(store) = &mut self.store {
            store.put_down();
        }
    }

    /// The robot sets out: other programs are told what the store is held for, until it is [back](Engine::come_back).
    ///
    /// # Errors
    /// The store is not this program's, or cannot be written: what the robot did could not be noted.
    pub fn set_out(&mut self) -> Result<(), Error> {
        Ok(self.store.as_mut().map_or(Ok(()), Store::set_out)?)
    }

    /// The robot is back.
    pub fn come_back(&mut self) {
        if let Some(store) = &mut self.store {
            store.come_back();
        }
    }

    fn with_what_others_wrote(
        &mut self,
        look: impl FnOnce(&mut Store) -> Result<Meanwhile, StoreError>,
    ) -> Result<bool, Error> {
        let Some(store) = &mut self.store else { return Ok(false) };
        let before = store.revision();
        let found = look(store)?;
        match found {
            Meanwhile::Nothing => return Ok(false),
            Meanwhile::Records if store.revision() == before => {
                let (state, store) = self.next_with_store();
                state.stand_on(store);
            }
            Meanwhile::Records | Meanwhile::Anew => self.reread()?,
        }
        Ok(true)
    }
}
