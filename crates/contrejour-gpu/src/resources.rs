//! Buffers and textures, made exactly as frame plans list them.

use std::collections::BTreeMap;

use contrejour_plan::{BufferKind, BufferPlan, FramePlan, TextureFormat, TextureKind, TexturePlan};

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

/// Buffers that a plan lists, by kind and page.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    by_place: BTreeMap<(BufferKind, usize), wgpu::Buffer>,
}

/// A buffer that was made.
#[derive(Debug)]
pub(crate) struct MadeBuffer {
    pub place: (BufferKind, usize),
    /// The one that it replaces, of another size.
    pub old: Option<wgpu::Buffer>,
}

impl Buffers {
    /// Makes what is listed and does not exist in that size, drops what is not listed; returns what was made.
    pub fn follow<'a>(
        &mut self,
        device: &wgpu::Device,
        listed: impl Iterator<Item = &'a BufferPlan>,
    ) -> Vec<MadeBuffer> {
        let mut old = std::mem::take(&mut self.by_place);
        let mut made = Vec::new();
        for BufferPlan { kind, page, bytes, .. } in listed {
            let place = (*kind, *page);
            let old = old.remove(&place);
            if let Some(kept) = old.as_ref().filter(|old| old.size() == *bytes) {
                self.by_place.insert(place, kept.clone());
                continue;
            }
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(kind.name()),
                size: *bytes,
                usage: usage(*kind),
                mapped_at_creation: false,
            });
            self.by_place.insert(place, buffer);
            made.push(MadeBuffer { place, old });
        }
        made
    }

    pub fn is_empty(&self) -> bool {
        self.by_place.is_empty()
    }

    /// The buffer of a page, or the one that serves all pages.
    pub fn find(&self, kind: BufferKind, page: usize) -> Option<&wgpu::Buffer> {
        self.by_place.get(&(kind, if kind.is_paged() { page } else { 0 }))
    }

    /// The buffers of a kind, page by page.
    pub fn all(&self, kind: BufferKind) -> impl Iterator<Item = &wgpu::Buffer> {
        self.by_place.range((kind, 0)..=(kind, usize::MAX)).map(|(_, buffer)| buffer)
    }

    /// A buffer that the plan lists, since it lists a stage that binds it.
    ///
    /// # Panics
    ///
    /// When the plan lists a stage without its buffers: a defect of the plan, which its tests rule out.
    pub fn get(&self, kind: BufferKind, page: usize) -> &wgpu::Buffer {
        match self.find(kind, page) {
            Some(buffer) => buffer,
            None => panic!("the frame plan lists no buffer `{}` for a stage that binds it", kind.name()),
        }
    }
}

/// Where the bindings of a view lie: pools and lists that all lights share, and what its light has of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bindings<'a> {
    pub shared: &'a Buffers,
    pub of_light: &'a Buffers,
    /// Index of the view among those of the light.
    pub view: usize,
}

impl Bindings<'_> {
    /// A bind group of a page's buffers in the order of their bindings, and a texture.
    pub fn bind(
        &self,
        device: &wgpu::Device,
        label: &str,
        layout: &wgpu::BindGroupLayout,
        (kinds, page): (&[BufferKind], usize),
        texture: Option<(u32, &wgpu::TextureView)>,
    ) -> wgpu::BindGroup {
        let buffers = kinds
            .iter()
            .zip(0..)
            .map(|(kind, binding)| wgpu::BindGroupEntry { binding, resource: self.resource(*kind, page) });
        let textures = texture.map(|(binding, view)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let entries: Vec<_> = buffers.chain(textures).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
    }

    fn resource(&self, kind: BufferKind, page: usize) -> wgpu::BindingResource<'_> {
        if kind != BufferKind::LightView {
            return self.shared.get(kind, page).as_entire_binding();
        }
        // Records of views are as far apart as uniforms must be.
        let size = kind.item_bytes();
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: self.of_light.get(kind, page),
            offset: self.view as u64 * size,
            size: wgpu::BufferSize::new(size),
        })
    }
}

/// How shaders see a buffer.
pub(crate) fn binding_type(kind: BufferKind, read_only: bool) -> wgpu::BufferBindingType {
    match kind {
        BufferKind::LightView | BufferKind::ReceiverView => wgpu::BufferBindingType::Uniform,
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

/// Every buffer can be read back by tools and tests.
fn usage(kind: BufferKind) -> wgpu::BufferUsages {
    let common = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    common
        | match kind {
            BufferKind::LightView | BufferKind::ReceiverView => wgpu::BufferUsages::UNIFORM,
            BufferKind::ItemArgs
            | BufferKind::RecheckArgs
            | BufferKind::RefineArgs
            | BufferKind::ExtrudeArgs
            | BufferKind::DrawArgs => wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT,
            _ => wgpu::BufferUsages::STORAGE,
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
