//! Textures, made exactly as frame plans list them, and what shaders bind.

use std::collections::BTreeMap;

use contrejour_plan::{BufferKind, FramePlan, TextureFormat, TextureKind, TexturePlan};

use crate::buffers::Buffers;

/// A texture that shaders load from without a sampler.
pub(crate) const UNFILTERED_FLOAT: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: false },
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};

/// The same in layers, one for each view.
pub(crate) const UNFILTERED_LAYERS: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: false },
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// Layers that shaders look up through a weighing sampler.
pub(crate) const FILTERED_LAYERS: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: true },
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// Layers of hardware depth.
pub(crate) const DEPTH_LAYERS: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Depth,
    view_dimension: wgpu::TextureViewDimension::D2Array,
    multisampled: false,
};

/// A hardware depth buffer of the eye's.
pub(crate) const DEPTH: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Depth,
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};

/// Where bindings lie: pools and lists that all lights share, and whose parts of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bindings<'a> {
    pub shared: &'a Buffers,
    pub whose: Whose<'a>,
}

/// Whose parts of shared buffers are bound, and whose record of a view.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Whose<'a> {
    /// Those of all views that are tested together.
    Bundle,
    /// Those of the view that has this seat.
    Seat(usize),
    /// No parts, and the record of this view among those that a light has.
    View(&'a Buffers, usize),
}

impl Bindings<'_> {
    /// A bind group of a page's buffers in the order of their bindings.
    pub fn bind(
        &self,
        device: &wgpu::Device,
        label: &str,
        layout: &wgpu::BindGroupLayout,
        (kinds, page): (&[BufferKind], usize),
    ) -> wgpu::BindGroup {
        let entry = |(kind, binding): (&BufferKind, u32)| wgpu::BindGroupEntry {
            binding,
            resource: self.resource(*kind, page),
        };
        let entries: Vec<_> = kinds.iter().zip(0..).map(entry).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
    }

    fn resource(&self, kind: BufferKind, page: usize) -> wgpu::BindingResource<'_> {
        // Records of views are as far apart as uniforms must be.
        let bytes = kind.item_bytes();
        let (buffer, offset, bytes) = match (self.whose, kind) {
            (Whose::View(of_light, view), BufferKind::LightView) => {
                (of_light.get(kind, page), view as u64 * bytes, bytes)
            }
            (Whose::Seat(seat), BufferKind::LightView) => {
                (self.shared.get(BufferKind::ViewBundle, page), seat as u64 * bytes, bytes)
            }
            (Whose::Seat(seat), kind) => {
                let part = self.shared.part(kind, page, seat);
                (part.buffer(), part.offset(), part.size())
            }
            _ => return self.shared.get(kind, page).as_entire_binding(),
        };
        wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset, size: wgpu::BufferSize::new(bytes) })
    }
}

/// How shaders see a buffer.
pub(crate) fn binding_type(kind: BufferKind, read_only: bool) -> wgpu::BufferBindingType {
    match kind {
        BufferKind::LightView | BufferKind::ViewBundle | BufferKind::ReceiverView => wgpu::BufferBindingType::Uniform,
        _ => wgpu::BufferBindingType::Storage { read_only },
    }
}

/// A format of the plan's in wgpu's words.
pub(crate) fn format(format: TextureFormat) -> wgpu::TextureFormat {
    match format {
        TextureFormat::R32Float => wgpu::TextureFormat::R32Float,
        TextureFormat::R16Float => wgpu::TextureFormat::R16Float,
        TextureFormat::Rg16Float => wgpu::TextureFormat::Rg16Float,
        TextureFormat::Rg32Float => wgpu::TextureFormat::Rg32Float,
        TextureFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        TextureFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        TextureFormat::Depth32Float => wgpu::TextureFormat::Depth32Float,
    }
}

/// The textures that a light's plan lists.
#[derive(Debug, Default)]
pub(crate) struct Textures {
    by_kind: BTreeMap<TextureKind, Map>,
}

/// A texture with views of it.
#[derive(Debug)]
struct Map {
    texture: wgpu::Texture,
    /// All layers and levels.
    whole: wgpu::TextureView,
    /// Each level of each layer.
    levels: Vec<Vec<wgpu::TextureView>>,
}

impl Map {
    fn new(device: &wgpu::Device, listed: &TexturePlan) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(listed.kind.name()),
            size: wgpu::Extent3d { width: listed.size, height: listed.size, depth_or_array_layers: listed.layers },
            mip_level_count: listed.levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: format(listed.format),
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let part = |layer, level| wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            base_mip_level: level,
            mip_level_count: Some(1),
            ..Default::default()
        };
        let levels = |layer| (0..listed.levels).map(|level| texture.create_view(&part(layer, level))).collect();
        let levels = (0..listed.layers).map(levels).collect();
        let whole =
            wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() };
        Self { whole: texture.create_view(&whole), levels, texture }
    }

    fn is(&self, listed: &TexturePlan) -> bool {
        let Self { texture, .. } = self;
        texture.width() == listed.size
            && texture.format() == format(listed.format)
            && texture.depth_or_array_layers() == listed.layers
            && texture.mip_level_count() == listed.levels
    }
}

impl Textures {
    /// Makes what the plan lists and does not exist like that, drops what it does not list; says whether anything
    /// changed.
    pub fn follow(&mut self, device: &wgpu::Device, plan: &FramePlan) -> bool {
        let count = self.by_kind.len();
        self.by_kind.retain(|kind, map| plan.texture(*kind).is_some_and(|listed| map.is(listed)));
        let mut changed = self.by_kind.len() != count;
        for listed in &plan.textures {
            self.by_kind.entry(listed.kind).or_insert_with(|| {
                changed = true;
                Map::new(device, listed)
            });
        }
        changed
    }

    pub fn find(&self, kind: TextureKind) -> Option<&wgpu::Texture> {
        self.by_kind.get(&kind).map(|map| &map.texture)
    }

    /// All layers of a texture that the plan lists, since it lists a pass that uses it.
    ///
    /// # Panics
    ///
    /// When the plan lists a pass without its textures: a defect of the plan, which its tests rule out.
    pub fn whole(&self, kind: TextureKind) -> &wgpu::TextureView {
        &self.get(kind).whole
    }

    /// Each level of the layer of a view, or of the one layer that serves all views.
    ///
    /// # Panics
    ///
    /// As [`whole`](Self::whole).
    pub fn levels(&self, kind: TextureKind, view: usize) -> &[wgpu::TextureView] {
        let layers = &self.get(kind).levels;
        &layers[view.min(layers.len() - 1)]
    }

    fn get(&self, kind: TextureKind) -> &Map {
        match self.by_kind.get(&kind) {
            Some(map) => map,
            None => panic!("the frame plan lists no texture `{}` for a pass that uses it", kind.name()),
        }
    }
}
