//! This module makes objects of JavaScript of what a page shows.

use clsmith::report::comparison::Comparison;
use clsmith::report::html::{PageArray, PageContent};
use clsmith::report::render::human::{HumanRenderOptions, render_human};
use clsmith::{Diagnostic, Failure};
use js_sys::{Float32Array, Object, Reflect, Uint8Array, Uint16Array, Uint32Array};
use std::io;
use wasm_bindgen::JsValue;

/// The columns of a finding's drawing.
const FAILURE_COLUMNS: usize = 110;

/// Makes the object of a page: `sections` by mark, `facts` as JSON, `arrays` by name, and `output`, the bytes of the
/// corrected program, if there is one.
pub(crate) fn build_page(comparison: &Comparison<'_>, output: Option<Vec<u8>>) -> Result<Object, Failure> {
    let content = PageContent::from_comparison(comparison).map_err(|error| unwritten(&error))?;
    let sections = Object::new();
    for (mark, html) in content.sections {
        set_value(&sections, mark, &html.into());
    }
    let arrays = Object::new();
    for (name, array) in content.arrays {
        set_value(&arrays, &name, &to_typed_array(&array));
    }
    let page = Object::new();
    set_value(&page, "sections", &sections);
    set_value(&page, "facts", &content.facts.into());
    set_value(&page, "arrays", &arrays);
    if let Some(bytes) = output {
        set_value(&page, "output", &Uint8Array::from(bytes.as_slice()));
    }
    Ok(page)
}

/// Makes the object of findings without which there is no page: `failure`, their text as a terminal shows it.
pub(crate) fn build_failure(findings: &[Diagnostic]) -> Object {
    let options = HumanRenderOptions::default().with_width(FAILURE_COLUMNS);
    let mut text = Vec::new();
    let failure = Object::new();
    let text = match render_human(&mut text, findings, None, &options) {
        // The last line counts them.
        Ok(()) => String::from_utf8_lossy(&text)
            .trim_end()
            .rsplit_once('\n')
            .unwrap_or_default()
            .0
            .trim_end()
            .to_owned(),
        Err(error) => error.to_string(),
    };
    set_value(&failure, "failure", &text.into());
    failure
}

/// Returns the array in memory of JavaScript, where it can be handed on without another copy.
fn to_typed_array(array: &PageArray) -> JsValue {
    match array {
        PageArray::F32(values) => Float32Array::from(values.as_slice()).into(),
        PageArray::Growing(values) => Uint32Array::from(values.as_slice()).into(),
        PageArray::U16(values) => Uint16Array::from(values.as_slice()).into(),
        PageArray::U8(values) => Uint8Array::from(values.as_slice()).into(),
    }
}

fn set_value(object: &Object, name: &str, value: &JsValue) {
    let is_set = Reflect::set(object, &name.into(), value);
    debug_assert!(is_set.is_ok(), "a new object takes every property");
}

fn unwritten(error: &io::Error) -> Failure {
    Diagnostic::new(clsmith::diagnostic::codes::UNWRITABLE, error.to_string()).into()
}
