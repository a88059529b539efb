// Steps of integer arithmetic on limbs of 32 bits, the lowest first. Negative numbers are two's complement.

// x * y + addend + carry, which is never more than 64 bits: the low and the high limb.
fn multiply_add(x: u32, y: u32, addend: u32, carry: u32) -> vec2u {
    let x_low = x & 0xffffu;
    let x_high = x >> 16u;
    let y_low = y & 0xffffu;
    let y_high = y >> 16u;
    let middle = x_low * y_high + (x_low * y_low >> 16u);
    let cross = x_high * y_low + (middle & 0xffffu);
    let high = x_high * y_high + (middle >> 16u) + (cross >> 16u);
    let with_addend = x * y + addend;
    let with_carry = with_addend + carry;
    return vec2u(with_carry, high + u32(with_addend < addend) + u32(with_carry < carry));
}

// x + y + carry, where carry is 0 or 1: the limb and the next carry.
fn add_carry(x: u32, y: u32, carry: u32) -> vec2u {
    let without_carry = x + y;
    let sum = without_carry + carry;
    return vec2u(sum, u32(without_carry < x) + u32(sum < carry));
}

// All bits set when the number with this top limb is negative, else none.
fn sign_mask(top_limb: u32) -> u32 {
    return 0u - (top_limb >> 31u);
}
