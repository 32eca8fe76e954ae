//! Importers and exporters of foreign formats. None is written yet: the map file is read by [`crate::map`].
