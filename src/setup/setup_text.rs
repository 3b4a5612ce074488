//! This module holds a setup as it is written: what serde reads, and what the JSON schema gives editors.

use super::machine_limits::MachineText;
use super::material_text::MaterialText;
use super::setup_reader::SetupReader;
use super::shop_words::ShopWordsText;
use super::stock_text::StockText;
use super::tools::ToolText;
use super::{Setup, YamlLocation};
use crate::diagnostic::Failure;
use crate::parameters::LengthUnit;
use crate::source::Source;
use crate::yaml::YamlDocument;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// A setup file as it is written.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
#[schemars(title = "clsmith setup file")]
struct SetupFileText {
    /// The unit of every length in this file. Feeds are in this unit per minute.
    #[serde(default)]
    units: LengthUnit,
    /// The machine and its limits.
    #[serde(default)]
    machine: MachineText,
    /// The stock before the first cut.
    stock: Option<StockText>,
    /// What the CL file does not state about tools. The first entry that matches a tool counts.
    #[serde(default)]
    tools: Option<Vec<ToolText>>,
    /// The work material.
    material: Option<MaterialText>,
    /// What the shop's own words mean, so that operations are found by them, frames and channels are
    /// understood, and nothing is said of texts: `{ OP_NAME: operation, TDATA: text }`. A word is the first
    /// word of a statement, or the beginning of its text (`PPRINT/OPERATION`); case and blanks do not count.
    #[serde(default)]
    words: ShopWordsText,
}

/// The data around the program: machine, stock, tools and material.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Setup")]
pub(crate) struct SetupText {
    /// The machine and its limits.
    #[serde(default)]
    machine: MachineText,
    /// The stock before the first cut.
    stock: Option<StockText>,
    /// What the CL file does not state about tools. The first entry that matches a tool counts.
    tools: Option<Vec<ToolText>>,
    /// The work material.
    material: Option<MaterialText>,
    /// What the shop's own words mean, so that operations are found by them, frames and channels are
    /// understood, and nothing is said of texts: `{ OP_NAME: operation, TDATA: text }`. A word is the first
    /// word of a statement, or the beginning of its text (`PPRINT/OPERATION`); case and blanks do not count.
    #[serde(default)]
    words: ShopWordsText,
}

/// Reads a setup file.
pub(super) fn load_setup(source: &Arc<Source>) -> Result<Setup, Failure> {
    let document = YamlDocument::parse(source)?;
    let SetupFileText { units, machine, stock, tools, material, words } =
        document.deserialize_checked(|_| None)?;
    SetupText { machine, stock, tools, material, words }
        .check_setup(units, YamlLocation::new(&Arc::new(document), &[]))
}

/// Returns the JSON schema of a setup file.
pub(super) fn setup_file_schema() -> serde_json::Value {
    crate::yaml::make_file_schema::<SetupFileText>("setup")
}

impl SetupText {
    /// Returns the setup in millimetres, with its places.
    ///
    /// # Errors
    /// Returns the faults that serde cannot find: values that are valid by themselves, but do not fit
    /// together. At most 20 findings are returned.
    pub(crate) fn check_setup(self, units: LengthUnit, place: YamlLocation) -> Result<Setup, Failure> {
        let mut reader = SetupReader::new(units);
        let list = place.at_key("tools");
        let tools = self.tools.into_iter().flatten().enumerate();
        let setup = Setup {
            machine: self.machine.check_limits(&mut reader, &place.at_key("machine")),
            stock: self.stock.and_then(|stock| stock.check_stock(&mut reader, place.at_key("stock"))),
            tools: tools.map(|(index, tool)| tool.check_tool(&mut reader, list.at_index(index))).collect(),
            material: self
                .material
                .and_then(|material| material.check_material(&mut reader, &place.at_key("material"))),
            vocabulary: self.words.into_vocabulary(),
        };
        reader.finish_value(setup)
    }
}
