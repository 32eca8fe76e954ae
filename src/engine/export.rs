//! The map in other programs' formats.

use crate::exchange::{
    Grid, GridFiles, MOST_CELLS, Mask, to_geojson, to_grid, to_map_file, to_masks,
    to_passframe_mesh, to_records, to_route_graph, to_route_graph_of_all,
};
use crate::map::Format;
use crate::units::{MapId, Timestamp};

use super::error::in_both;
use super::{Engine, Error, RequestError};

impl Engine {
    /// The whole map as a map file, which [`Engine::import`] reads.
    ///
    /// # Errors
    /// There is no map.
    pub fn export_map(&self, format: Format) -> Result<String, Error> {
        Ok(to_map_file(self.world()?, format))
    }

    /// All floors as GeoJSON in metres: rooms, openings, furniture, places.
    ///
    /// # Errors
    /// There is no map.
    pub fn export_geojson(&self) -> Result<String, Error> {
        Ok(to_geojson(self.world()?, self.floors()?.values()))
    }

    /// A floor as ROS map_server has it; `cell` is the size of a cell in cm.
    ///
    /// # Errors
    /// There is no map, or its picture would be too large.
    pub fn export_grid(&self, map: MapId, cell: f64) -> Result<GridFiles, Error> {
        let world = self.world()?;
        to_grid(world, self.floor(map)?, cell).ok_or_else(|| self.too_large(map))
    }

    /// The same, cut at the height of a laser above the Map's zero, in cm: what that meets.
    ///
    /// # Errors
    /// As [`Engine::export_grid`].
    pub fn export_laser_grid(
        &self,
        map: MapId,
        cell: f64,
        height: f64,
    ) -> Result<GridFiles, Error> {
        let key = &self.world()?.maps[&map].key;
        let grid = Grid::of_laser(self.floor(map)?, cell, height);
        let grid = grid.ok_or_else(|| self.too_large(map))?;
        Ok(grid.into_files(format!("{key}-laser")))
    }

    /// The zones of a floor that are in force at a moment, as masks of Nav2's costmap filters.
    ///
    /// # Errors
    /// As [`Engine::export_grid`].
    pub fn export_masks(&self, map: MapId, cell: f64, at: Timestamp) -> Result<Vec<Mask>, Error> {
        let masks = to_masks(self.world()?, self.floor(map)?, cell, |zone| zone.is_in_force(at));
        masks.ok_or_else(|| self.too_large(map))
    }

    fn too_large(&self, map: MapId) -> Error {
        let world = self.world().expect("its floor was found");
        let map = in_both(world, &world.maps[&map].name);
        RequestError::GridTooLarge { map, limit: MOST_CELLS }.into()
    }

    /// The Passframes of all floors, or of one, as triangles: Wavefront OBJ.
    ///
    /// # Errors
    /// There is no map.
    pub fn export_mesh(&self, only: Option<MapId>) -> Result<String, Error> {
        let floors = self.floors()?.values();
        let floors = floors.filter(|plan| only.is_none_or(|map| plan.map() == map));
        Ok(to_passframe_mesh(self.world()?, floors))
    }

    /// A floor as a route graph for Nav2's route server.
    ///
    /// # Errors
    /// There is no map.
    pub fn export_route_graph(&self, map: MapId) -> Result<String, Error> {
        Ok(to_route_graph(self.world()?, self.floor(map)?))
    }

    /// All floors as one route graph, joined by lifts.
    ///
    /// # Errors
    /// There is no map.
    pub fn export_route_graph_of_all(&self) -> Result<String, Error> {
        Ok(to_route_graph_of_all(self.world()?, self.floors()?))
    }

    /// Every table of the store with every version of every record, as JSON.
    ///
    /// # Errors
    /// There is no map, or a record is broken.
    pub fn export_records(&self) -> Result<String, Error> {
        let world = self.world()?;
        Ok(to_records(&self.store()?.reader(), world)?)
    }
}

#[cfg(feature = "sqlite")]
mod sqlite {
    use std::path::Path;

    use crate::engine::{Change, Engine, Error, RequestError};
    use crate::exchange::{read_sqlite, write_sqlite};
    use crate::map::{MapErrors, check};
    use crate::store::{ImportReport, Sheet};

    impl Engine {
        /// The store's map as tables of paper 2 in a new SQLite file.
        ///
        /// # Errors
        /// There is no map, there is such a file already, or SQLite fails.
        pub fn export_sqlite(&self, path: &Path) -> Result<(), Error> {
            let world = self.world()?;
            Ok(write_sqlite(path, &self.store()?.reader(), world)?)
        }

        /// Makes the map of an SQLite file the store's map, in one transaction; ids are the file's.
        ///
        /// # Errors
        /// The file is none, its rows make no world, or the world does not pass the checks of a map file; the store
        /// is then as it was.
        pub fn import_sqlite(
            &mut self,
            path: &Path,
            change: &Change,
        ) -> Result<ImportReport, Error> {
            let no_map = || RequestError::NoMap { store: path.display().to_string() };
            let world = read_sqlite(path)?.world()?.ok_or_else(no_map)?;
            let faults = MapErrors { source: None, faults: check(&world) };
            if faults.has_errors() {
                return Err(faults.into());
            }
            let report = match &mut self.store {
                // Sizes and lengths are computed anew: who edits a corner in SQL need not.
                Some(store) => {
                    let report = store.import_sheet(&Sheet::of(&world)?, change)?;
                    self.reread()?;
                    report
                }
                None => {
                    self.follow(world)?;
                    ImportReport::default()
                }
            };
            Ok(report)
        }
    }
}
