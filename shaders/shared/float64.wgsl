// 64-bit floats by integers. Products and sums round to the nearest, ties to even, as the CPU's do (IEEE 754-2019), so
// that both bring a light to the same bits. Exponents have a word of their own, so nothing overflows or underflows.

struct Float64 {
    // The top bit set where it is negative.
    sign: u32,
    // Of the mantissa's lowest bit.
    exponent: i32,
    // 64 bits, the low word first, of which the lowest 11 are zeros and the top one is set; zeros for zero.
    mantissa: vec2u,
}

const SIGN_BIT = 0x80000000u;
const FLOAT64_ZERO = Float64(0u, 0, vec2u(0u));
const FLOAT64_ONE = Float64(0u, -63, vec2u(0u, SIGN_BIT));

// Half a unit of the 53 bits that a mantissa keeps, and that unit.
const HALF_UNIT = 0x400u;
const UNIT = 0x800u;

// From memory, the low word first. Numbers below 2^-1022 count as zero.
fn float64(bits: vec2u) -> Float64 {
    let exponent = (bits.y >> 20u) & 0x7ffu;
    if exponent == 0u {
        return FLOAT64_ZERO;
    }
    let high = ((bits.y & 0xfffffu) | 0x100000u) << 11u;
    return Float64(bits.y & SIGN_BIT, i32(exponent) - 1086, vec2u(bits.x << 11u, high | bits.x >> 21u));
}

fn is_zero(x: Float64) -> bool {
    return x.mantissa.y == 0u;
}

fn negative(x: Float64) -> Float64 {
    return Float64(x.sign ^ SIGN_BIT, x.exponent, x.mantissa);
}

fn product(x: Float64, y: Float64) -> Float64 {
    if is_zero(x) || is_zero(y) {
        return FLOAT64_ZERO;
    }
    let p00 = multiply_add(x.mantissa.x, y.mantissa.x, 0u, 0u);
    let p01 = multiply_add(x.mantissa.x, y.mantissa.y, 0u, p00.y);
    let p10 = multiply_add(x.mantissa.y, y.mantissa.x, p01.x, 0u);
    let p11 = multiply_add(x.mantissa.y, y.mantissa.y, p01.y, p10.y);
    // The upper half, its top bit set; what is below leaves a trace in the lowest bit.
    let is_long = p11.y >= SIGN_BIT;
    let high = select(p11.y << 1u | p11.x >> 31u, p11.y, is_long);
    let low = select(p11.x << 1u | p10.x >> 31u, p11.x, is_long);
    let trace = u32(p00.x != 0u || select(p10.x << 1u, p10.x, is_long) != 0u);
    let exponent = x.exponent + y.exponent + select(63, 64, is_long);
    return rounded(x.sign ^ y.sign, exponent, vec2u(low | trace, high));
}

fn sum(x: Float64, y: Float64) -> Float64 {
    if is_zero(x) || is_zero(y) {
        if is_zero(x) {
            return y;
        }
        return x;
    }
    // Align the smaller one.
    let x_is_larger = x.exponent > y.exponent || (x.exponent == y.exponent && is_less(y.mantissa, x.mantissa));
    var large = y;
    var small = x;
    if x_is_larger {
        large = x;
        small = y;
    }
    let aligned = shifted_right(small.mantissa, u32(large.exponent - small.exponent));

    // Add or subtract.
    if large.sign == small.sign {
        let low = add_carry(large.mantissa.x, aligned.x, 0u);
        let high = add_carry(large.mantissa.y, aligned.y, low.y);
        let total = vec2u(low.x, high.x);
        if high.y == 0u {
            return rounded(large.sign, large.exponent, total);
        }
        let halved = shifted_right(total, 1u);
        return rounded(large.sign, large.exponent + 1, vec2u(halved.x, halved.y | SIGN_BIT));
    }
    let low = large.mantissa.x - aligned.x;
    let high = large.mantissa.y - aligned.y - u32(large.mantissa.x < aligned.x);
    if (low | high) == 0u {
        return FLOAT64_ZERO;
    }
    let zeros = select(countLeadingZeros(high), 32u + countLeadingZeros(low), high == 0u);
    return rounded(large.sign, large.exponent - i32(zeros), shifted_left(vec2u(low, high), zeros));
}

// To the 53 bits that are kept.
fn rounded(sign: u32, exponent: i32, mantissa: vec2u) -> Float64 {
    let rest = mantissa.x & (UNIT - 1u);
    let is_up = rest > HALF_UNIT || (rest == HALF_UNIT && (mantissa.x & UNIT) != 0u);
    let low = add_carry(mantissa.x - rest, select(0u, UNIT, is_up), 0u);
    let high = add_carry(mantissa.y, 0u, low.y);
    if high.y == 1u {
        return Float64(sign, exponent + 1, vec2u(0u, SIGN_BIT));
    }
    return Float64(sign, exponent, vec2u(low.x, high.x));
}

fn is_less(x: vec2u, y: vec2u) -> bool {
    return x.y < y.y || (x.y == y.y && x.x < y.x);
}

// By any number of bits; what is lost leaves a trace in the lowest bit, where it may decide a rounding.
fn shifted_right(x: vec2u, bits: u32) -> vec2u {
    if bits == 0u {
        return x;
    }
    if bits < 32u {
        let trace = u32(x.x << (32u - bits) != 0u);
        return vec2u(x.x >> bits | x.y << (32u - bits) | trace, x.y >> bits);
    }
    if bits < 64u {
        let lost_high = select(x.y << (64u - bits), 0u, bits == 32u);
        return vec2u(x.y >> (bits - 32u) | u32((x.x | lost_high) != 0u), 0u);
    }
    // Too little to matter, whatever is added to it.
    return vec2u(0u);
}

// By less than 64 bits.
fn shifted_left(x: vec2u, bits: u32) -> vec2u {
    if bits == 0u {
        return x;
    }
    if bits < 32u {
        return vec2u(x.x << bits, x.y << bits | x.x >> (32u - bits));
    }
    return vec2u(0u, x.x << (bits - 32u));
}

const FLOAT32_INFINITY = 0x7f800000u;

// The exponent bits that the nearest f32 has where it is a normal number.
fn float32_exponent(x: Float64) -> i32 {
    return x.exponent + 190;
}

// The bits of the nearest f32; zeros have no sign.
fn float32_bits(x: Float64) -> u32 {
    let exponent = float32_exponent(x);
    if is_zero(x) || exponent < -24 {
        return 0u;
    }
    if exponent >= 255 {
        return x.sign | FLOAT32_INFINITY;
    }
    let is_normal = exponent >= 1;
    let mantissa = shifted_right(x.mantissa, select(u32(1 - exponent), 0u, is_normal));
    let kept = mantissa.y >> 8u;
    let rest = mantissa.y & 0xffu;
    let is_up = rest > 0x80u || (rest == 0x80u && (mantissa.x != 0u || (kept & 1u) == 1u));
    // The hidden bit of a normal number adds one to the exponent.
    let size = (u32(select(0, exponent - 1, is_normal)) << 23u) + kept + u32(is_up);
    return select(0u, x.sign | size, size != 0u);
}

// Whether the nearest f32 has all of the 24 digits of a normal number, or is the number itself.
fn is_held_by_float32(x: Float64) -> bool {
    let exponent = float32_exponent(x);
    if is_zero(x) || exponent >= 1 {
        return is_zero(x) || float32_bits(x) << 1u != FLOAT32_INFINITY << 1u;
    }
    // The lowest bit of an f32 is that of 2^-149.
    let zeros = select(countTrailingZeros(x.mantissa.x), 32u + countTrailingZeros(x.mantissa.y), x.mantissa.x == 0u);
    let becomes_normal = float32_bits(x) << 1u >= 0x01000000u;
    return becomes_normal || x.exponent + i32(zeros) >= -149;
}
