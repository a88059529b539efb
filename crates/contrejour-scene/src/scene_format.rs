//! The format of scene files.
//!
//! A scene file is TOML. Lengths are in world units, y is up, colours are linear, and angles are in degrees (their
//! keys end in `_degrees`; everywhere in code angles are radians). A key that is not in these tables is refused, and
//! so is a number that is not finite or beyond 1e15. A scene has at most 65 536 meshes.
//!
//! ```toml
//! size = [1280, 720]
//!
//! [camera]
//! eye = [3, 2, 5]
//! target = [0, 0.5, 0]
//!
//! [light]
//! kind = "spot"
//! position = [-3, 5, 2]
//! target = [0, 0.5, 0]
//! radius = 0.2
//!
//! [[mesh]]
//! shape = { kind = "plane", size = [8, 8] }
//!
//! [[mesh]]
//! shape = { kind = "torus", radius = 0.8 }
//! rotate_degrees = [90, 0, 0]
//! translate = [0, 1.2, 0]
//! base_color = [0.8, 0.3, 0.1]
//! ```
//!
//! # The scene
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `size` | width and height of the picture, 1 to 16384 pixels each | `[1280, 720]` |
//! | `exposure_ev100` | exposure value at ISO 100 of lights with an `intensity`, -64 to 64: a luminance of 1.2 * 2^EV cd/m^2 is white | `0` |
//! | `ambient` | light that is everywhere, as bright as in the picture | `[0.16, 0.17, 0.19]` |
//! | `background` | colour where there is no mesh | `[0.55, 0.6, 0.66]` |
//! | `camera` | a table | must be given |
//! | `light` | a table, or an array of 1 to 256 tables | must be given |
//! | `shadow` | a table | the preset `medium` |
//! | `mesh` | an array of tables | must be given |
//!
//! # `[camera]`
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `eye` | where it is | must be given |
//! | `target` | what it looks at | must be given |
//! | `up` | which way is up | `[0, 1, 0]` |
//! | `fov_y_degrees` | full vertical opening angle, 0.01 to 179 | `40` |
//! | `near`, `far` | depths between which it sees | around all meshes |
//!
//! # `[light]`, `[[light]]`
//!
//! One light is `[light]`, several are `[[light]]` each. What is about one light, as reports are, takes the first.
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `kind` | `"spot"`, `"point"` or `"directional"` | must be given |
//! | `name` | a name for messages | the kind |
//! | `color` | without `intensity` what it sheds, with it its tint | `[1, 1, 1]` |
//! | `intensity` | how strong it is, 0 and up: candela, for a directional light lux | none: `color` says it |
//! | `casts` | whether it throws shadows | `true` |
//! | `shadow` | a table, as [`[shadow]`](#shadow) below; keys that it lacks are as there | the scene's |
//!
//! Without `intensity` a white surface that faces the light looks like `color` at a spot's target, at half the `far` of a
//! point light, and anywhere under a directional light; nearer it is brighter. So a scene looks alike in any unit of length.
//! With `intensity` world units are metres, and `exposure_ev100` says how bright the light is in the picture: a white
//! surface under E lux has a luminance of E / pi cd/m^2. Both kinds of light may be in one scene:
//!
//! ```toml
//! exposure_ev100 = 3
//!
//! [[light]]
//! kind = "point"
//! position = [1, 2, 0]
//! color = [1, 0.7, 0.4]
//! intensity = 120
//! range = 6
//!
//! [[light]]
//! kind = "directional"
//! towards_light = [1, 3, 2]
//! color = [0.1, 0.12, 0.2]
//! shadow = { technique = "gaussian-pcf", map_size = 2048 }
//! ```
//!
//! A spot light has:
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `position` | where it is | must be given |
//! | `target` | what it shines at | must be given |
//! | `cone_angle_degrees` | full opening angle, 0.01 to 179 | around all meshes, at most 130 |
//! | `inner_cone_angle_degrees` | full angle within which it is equally bright, 0 to the cone's | a soft rim, see [`SceneLight`](crate::SceneLight::inner_cone_angle) |
//! | `radius` | radius of the disk that shines, 0 and up | `0` |
//! | `range` | distance at which its light ends, more than 0 | it never does |
//! | `near`, `far` | depths between which it casts and is received | around all meshes |
//!
//! A point light, which shines in all directions, has:
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `position` | where it is | must be given |
//! | `radius` | radius of the sphere that shines, 0 and up | `0` |
//! | `range` | distance at which its light ends, more than 0 | it never does |
//! | `near`, `far` | depths, along the nearest axis of the world, between which it casts and is received | around all meshes |
//!
//! A directional light has:
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `towards_light` | direction from the scene to the light | must be given |
//! | `center` | middle of what is shadowed | the middle of all meshes |
//! | `half_extent` | half the side of the square that is shadowed | around all meshes |
//! | `half_depth` | half the depth that is shadowed | around all meshes |
//! | `angular_radius_degrees` | angular radius of the disk that shines, 0 to less than 90 | `0.27`, the sun's |
//!
//! With `cascades` it lights all that the camera sees, up to the camera's `far`: several maps follow the camera, finer
//! ones near it. Then it has, in place of `center`, `half_extent` and `half_depth`:
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `cascades` | how many maps there are, 1 to 8 | none: one map, that stands |
//! | `logarithmic_share` | how much deeper each map's part of the view is than the one before, 0 to 1 | `0.75` |
//! | `border_share` | last part of each part in which its map fades into the next one, 0 to 0.5 | `0.1` |
//! | `caster_margin` | how far in front of a map's part casters keep their exact depth, in multiples of the camera's `far`, 0 to 1000 | `1` |
//!
//! See [`CascadeSettings`](contrejour_plan::CascadeSettings).
//!
//! # `[shadow]`
//!
//! How the shadows of all lights are made, but for what a light's own `shadow` says.
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `preset` | `"low"`, `"medium"`, `"high"` or `"ultra"`: where the other defaults come from | `"medium"` |
//! | `technique` | `"shadow-map"`, `"pcf"`, `"gaussian-pcf"`, `"bicubic-pcf"`, `"pcss"`, `"vsm"`, `"evsm"`, `"vsm-pcss"`, `"evsm-pcss"`, `"smoothies"`, `"silhouette-map"`, `"silhouette-map-tam"` or `"silhouette-map-stream"`; see [`Technique`](contrejour_plan::Technique) | `"smoothies"` |
//! | `map_size` | texels along a side of the maps, 1 to 16384 | the preset's |
//! | `depth_bits` | `16` or `32`: how exactly the maps keep linear depth | `32` |
//! | `bias_constant_texels`, `bias_slope_texels`, `bias_normal_texels`, `bias_smoothie_texels` | depth biases, 0 and up; see [`DepthBias`](contrejour_plan::DepthBias) | the preset's |
//!
//! Smoothies have these keys too:
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `width_ndc` | width of the smoothies on the map, whose side is 2; more than 0, up to 2 | from the light's size |
//! | `width_max_ndc` | largest width of the smoothies; more than 0, up to 2 | the preset's |
//! | `remap` | `"contact"`: soft edges harden at the contact; `"off"`: they do not, for comparison | `"contact"` |
//!
//! Silhouette maps of all kinds:
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `edge_texels` | how wide the hardest edge is, in texels; more than 0, up to 4 | `0.5` |
//! | `width_max_ndc` | largest half width of a penumbra on the map; more than 0, up to 2 | `0.1` |
//! | `samples` | places at which a soft edge is looked up, 1 to 1024 | `8` |
//! | `blending` | `0`: the nearest silhouette's distance and depth by depth that fragments write; `1`: the least of both by blending | `0` |
//! | `stream_bits` | `16` or `32`, for `silhouette-map-stream`: the floats of its stream | `32` |
//! | `profile` | `"disk"`: a soft edge is as that of a disk of light; `"linear"`: it goes evenly from dark to lit | `"disk"` |
//!
//! Others:
//!
//! | Key | Techniques | Value | Default |
//! | --- | --- | --- | --- |
//! | `kernel` | `gaussian-pcf` | texels along the filter's side: 3, 5 or 7 | `5` |
//! | `blocker_samples`, `filter_samples` | `pcss` | look-ups, 1 to 1024 | `16`, `32` |
//! | `search_max_ndc` | `pcss`, `vsm-pcss`, `evsm-pcss` | largest radius of the search for blockers; more than 0, up to 2 | `0.2` |
//! | `blur_texels` | `vsm`, `evsm` | radius of the blur, 0 to 1024 | `4` |
//! | `warp_exponent` | `evsm`, `evsm-pcss` | exponent of the warp, more than 0, up to 42 | `40` |
//! | `bleed_cut`, `min_variance` | the four | see [`VarianceSettings`](contrejour_plan::VarianceSettings) | there |
//!
//! A key of another technique than the one that is named is refused.
//!
//! # `[[mesh]]`
//!
//! | Key | Value | Default |
//! | --- | --- | --- |
//! | `shape` | a table, see below | either this |
//! | `file` | a mesh file (.obj, .gltf, .glb, .ply, .stl), relative to the scene file; of a glTF file's cameras and lights none is taken | or this |
//! | `name` | a name for messages | the shape's kind, or the name in the file |
//! | `scale` | one number or three, not 0 | `1` |
//! | `rotate_degrees` | turns about x, then y, then z, after scaling | `[0, 0, 0]` |
//! | `translate` | moves after turning | `[0, 0, 0]` |
//! | `base_color` | colour of the surface, 0 to 1, in place of its own and its textures | the mesh's own |
//! | `casts` | whether it throws a shadow; without, shadows on it do not harden at the contact | `true` |
//! | `receives` | whether it takes shadows | `true` |
//!
//! # `shape`
//!
//! | `kind` | Keys with their defaults |
//! | --- | --- |
//! | `"plane"` | `size = [10, 10]`, `segments = 1` |
//! | `"box"` | `size = [1, 1, 1]` |
//! | `"cylinder"` | `radius = 0.5`, `height = 1`, `segments = 96` |
//! | `"sphere"` | `radius = 0.5`, `segments = 64` |
//! | `"torus"` | `radius = 1`, `tube_radius = 0.35`, `segments = 128`, `sides = 48` |
//! | `"knot"` | `radius = 1`, `tube_radius = 0.22`, `segments = 320`, `sides = 40` |
//! | `"fence"` | `size = [4, 2, 0.04]`, `columns = 32`, `rows = 16`, `bar = 0.04` |
//! | `"elephant"` | `height = 2`, `segments = 48` |
//!
//! Their meaning and ranges stand at [`Shape`](crate::shapes::Shape).
