//! Pictures that unpack to more than their files deserve.

use std::io::Cursor;

use contrejour_properties::{check_picture, most_bytes_of_picture};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, GrayImage, ImageFormat};

use crate::{measured, turn};

/// Checks a picture with its memory and its time; whether it is decoded.
fn is_decoded(what: &str, bytes: &[u8]) -> bool {
    let (texels, held) = measured(what, || check_picture(bytes));
    let most = most_bytes_of_picture(bytes.len(), texels);
    assert!(held <= most, "{what}: {} bytes held {held} bytes, the bound is {most}", bytes.len());
    texels.is_some()
}

fn black_png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::NoFilter);
    GrayImage::new(width, height).write_with_encoder(encoder).expect("it fits into memory");
    bytes
}

#[test]
fn pictures_of_one_colour() {
    // What makes the pictures takes memory too.
    let _turn = turn();
    assert!(is_decoded("a black picture", &black_png(4096, 4096)));
    assert!(!is_decoded("a large black picture", &black_png(8192, 8192)));
    assert!(!is_decoded("a long picture", &black_png(1, 8193)));
}

#[test]
fn sizes_that_are_not_there() {
    let _turn = turn();
    // A JPEG of 16 x 16 texels whose header says 8192 x 8192.
    let mut jpeg = Cursor::new(Vec::new());
    DynamicImage::from(GrayImage::new(16, 16)).write_to(&mut jpeg, ImageFormat::Jpeg).expect("it fits into memory");
    let mut jpeg = jpeg.into_inner();
    let frame = jpeg.windows(2).position(|marker| marker == [0xff, 0xc0]).expect("it has a frame");
    for [high, low] in [[0x20, 0x00], [0x10, 0x00], [0xff, 0xff], [0x00, 0x00]] {
        jpeg[frame + 5..frame + 9].copy_from_slice(&[high, low, high, low]);
        is_decoded("a small JPEG with a large header", &jpeg);
    }
    let png = black_png(4096, 4096);
    for part in 1..16 {
        is_decoded("the start of a picture", &png[..part * png.len() / 16]);
    }
}
