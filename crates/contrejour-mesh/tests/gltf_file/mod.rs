//! A glTF file that a test writes itself: JSON with its buffer as a data URI.
#![allow(dead_code, reason = "each test that has this module uses a part of it")]

use std::fmt::Write;
use std::path::Path;

use contrejour_mesh::{AnimatedModel, LoadError, MeshFile, load_animated_bytes, load_gltf};
use serde_json::{Value, json};

/// A document with one mesh of one primitive, whose accessors are in the order in which they were added.
pub struct Builder {
    pub buffer: Vec<u8>,
    pub root: Value,
}

pub const F32: u32 = 5126;
pub const U16: u32 = 5123;
pub const I16: u32 = 5122;
pub const U8: u32 = 5121;

impl Builder {
    pub fn new() -> Self {
        let root = json!({
            "asset": {"version": "2.0"},
            "nodes": [{"mesh": 0, "name": "body"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [], "bufferViews": [],
        });
        Self { buffer: Vec::new(), root }
    }

    pub fn accessor(mut self, component: u32, kind: &str, count: usize, bytes: &[u8]) -> Self {
        let push = |list: &mut Value, item: Value| {
            let list = list.as_array_mut().expect("is a list");
            list.push(item);
            list.len() - 1
        };
        let view = json!({"buffer": 0, "byteOffset": self.buffer.len(), "byteLength": bytes.len()});
        let view = push(&mut self.root["bufferViews"], view);
        let accessor = json!({"bufferView": view, "componentType": component, "type": kind, "count": count});
        push(&mut self.root["accessors"], accessor);
        self.buffer.extend(bytes);
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        self
    }

    pub fn positions(self, positions: &[[f32; 3]]) -> Self {
        self.accessor(F32, "VEC3", positions.len(), &f32_bytes(positions.as_flattened()))
    }

    pub fn set(mut self, pointer: &str, value: Value) -> Self {
        let (parent, key) = pointer.rsplit_once('/').expect("starts with a slash");
        match self.root.pointer_mut(parent).expect("exists") {
            Value::Array(list) => list[key.parse::<usize>().expect("is an index")] = value,
            object => object[key] = value,
        }
        self
    }

    pub fn load(self) -> Result<MeshFile, LoadError> {
        load_gltf(self.text().as_bytes(), Path::new("literal.gltf"))
    }

    pub fn load_animated(self) -> Result<AnimatedModel, LoadError> {
        load_animated_bytes(self.text().as_bytes(), Path::new("literal.gltf"), &|_| unreachable!("it is alone"))
    }

    pub fn text(mut self) -> String {
        let mut hex = String::new();
        for byte in &self.buffer {
            write!(hex, "%{byte:02X}").expect("writing to a string cannot fail");
        }
        let uri = format!("data:application/octet-stream,{hex}");
        self.root["buffers"] = json!([{"byteLength": self.buffer.len(), "uri": uri}]);
        self.root.to_string()
    }

    pub fn loaded(self) -> MeshFile {
        self.load().unwrap_or_else(|error| panic!("{error}"))
    }

    pub fn refused(self) -> LoadError {
        let error = self.load().expect_err("is broken");
        assert!(!error.to_string().contains('\n'), "{error}");
        error
    }
}

pub fn f32_bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

pub fn u16_bytes(numbers: &[u16]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

pub const SQUARE: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

pub fn square() -> Builder {
    Builder::new().positions(&SQUARE)
}
