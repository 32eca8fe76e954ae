//! IFC models (IFC2x3, IFC4) as STEP text → [`Survey`]: storeys, spaces, doors, windows, openings without doors,
//! furniture. Walls are not read: they are what is between the spaces.
//!
//! Only the types of `WANTED` are taken apart; the rest of the file is passed over. A door is set where its
//! placement and its body say; the spaces that it joins are looked for on both sides of it, and where the model has
//! space boundaries they narrow the search.

mod building;
mod doors;
mod place;
mod shape;
mod step;

use super::{ReadError, Survey};
use crate::units::Source;

/// The types that are read.
const WANTED: [&str; 68] = [
    "IFCPROJECT",
    "IFCUNITASSIGNMENT",
    "IFCSIUNIT",
    "IFCCONVERSIONBASEDUNIT",
    "IFCMEASUREWITHUNIT",
    "IFCSITE",
    "IFCBUILDING",
    "IFCBUILDINGSTOREY",
    "IFCSPACE",
    "IFCDOOR",
    "IFCDOORSTANDARDCASE",
    "IFCDOORSTYLE",
    "IFCDOORTYPE",
    "IFCWINDOW",
    "IFCWINDOWSTANDARDCASE",
    "IFCOPENINGELEMENT",
    "IFCFURNISHINGELEMENT",
    "IFCFURNITURE",
    "IFCSYSTEMFURNITUREELEMENT",
    "IFCFURNITURETYPE",
    "IFCFURNISHINGELEMENTTYPE",
    "IFCRELAGGREGATES",
    "IFCRELCONTAINEDINSPATIALSTRUCTURE",
    "IFCRELDEFINESBYTYPE",
    "IFCRELFILLSELEMENT",
    "IFCRELSPACEBOUNDARY",
    "IFCRELSPACEBOUNDARY1STLEVEL",
    "IFCRELSPACEBOUNDARY2NDLEVEL",
    "IFCLOCALPLACEMENT",
    "IFCAXIS2PLACEMENT3D",
    "IFCAXIS2PLACEMENT2D",
    "IFCCARTESIANPOINT",
    "IFCDIRECTION",
    "IFCCARTESIANTRANSFORMATIONOPERATOR3D",
    "IFCPRODUCTDEFINITIONSHAPE",
    "IFCSHAPEREPRESENTATION",
    "IFCREPRESENTATIONMAP",
    "IFCMAPPEDITEM",
    "IFCEXTRUDEDAREASOLID",
    "IFCARBITRARYCLOSEDPROFILEDEF",
    "IFCARBITRARYPROFILEDEFWITHVOIDS",
    "IFCRECTANGLEPROFILEDEF",
    "IFCRECTANGLEHOLLOWPROFILEDEF",
    "IFCROUNDEDRECTANGLEPROFILEDEF",
    "IFCCIRCLEPROFILEDEF",
    "IFCCIRCLEHOLLOWPROFILEDEF",
    "IFCPOLYLINE",
    "IFCINDEXEDPOLYCURVE",
    "IFCCARTESIANPOINTLIST2D",
    "IFCCARTESIANPOINTLIST3D",
    "IFCCOMPOSITECURVE",
    "IFCCOMPOSITECURVESEGMENT",
    "IFCTRIMMEDCURVE",
    "IFCBOUNDINGBOX",
    "IFCFACETEDBREP",
    "IFCFACETEDBREPWITHVOIDS",
    "IFCCLOSEDSHELL",
    "IFCOPENSHELL",
    "IFCCONNECTEDFACESET",
    "IFCFACE",
    "IFCFACEOUTERBOUND",
    "IFCFACEBOUND",
    "IFCPOLYLOOP",
    "IFCPOLYGONALFACESET",
    "IFCINDEXEDPOLYGONALFACE",
    "IFCTRIANGULATEDFACESET",
    "IFCBOOLEANCLIPPINGRESULT",
    "IFCBOOLEANRESULT",
];

/// Reads an IFC model.
///
/// # Errors
/// [`ReadError::Syntax`] when it is no STEP text or breaks off, [`ReadError::NoBuilding`] when it has no space with
/// an outline, [`ReadError::TooMany`] when it has more than any building.
pub fn read(source: &Source) -> Result<Survey, ReadError> {
    let mut remarks = Vec::new();
    let all = step::instances(source, &WANTED, &mut remarks)?;
    building::survey(source.name(), &all, remarks)
}

/// Whether a text says that it is STEP.
#[must_use]
pub fn recognises(text: &str) -> bool {
    step::is_step(text)
}
