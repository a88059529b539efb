/// One field of a [`SharedStruct`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SharedField {
    /// Its name, on both sides.
    pub name: &'static str,
    /// Its offset from the start of the struct, in bytes.
    pub offset: usize,
}

/// Name, size and fields of a struct as Rust lays it out.
#[derive(Clone, Copy, Debug)]
pub struct SharedStruct {
    /// Its name, on both sides.
    pub name: &'static str,
    /// Its size in an array, in bytes.
    pub size: usize,
    /// Its fields in order.
    pub fields: &'static [SharedField],
}

/// Declares a plain-bytes struct together with the table that the naga comparison reads, so that no field can be
/// in one and not in the other.
macro_rules! shared_struct {
    ($(#[$meta:meta])* $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        pub struct $name { $($(#[$field_meta])* pub $field: $type,)* }

        impl $name {
            /// The layout, for comparison with WGSL.
            pub const SHARED: $crate::SharedStruct = $crate::SharedStruct {
                name: stringify!($name),
                size: size_of::<$name>(),
                fields: &[$($crate::SharedField {
                    name: stringify!($field),
                    offset: core::mem::offset_of!($name, $field),
                },)*],
            };
        }
    };
}

pub(crate) use shared_struct;
