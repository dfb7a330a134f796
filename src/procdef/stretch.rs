//! Local transformations: symmetric matrices that stretch along three axes, eight vertices at a time.

use super::charts::VolumeMode;
use crate::math::{Mat3, Vec3};
use wide::f32x8;

/// Vertices of a block.
pub const LANES: usize = 8;

/// `c1 d1 d1ᵀ + c2 d2 d2ᵀ + c3 d3 d3ᵀ` (equation 1) for orthonormal columns `d` of `frame` and rates `c`.
pub fn stretch_along(frame: &Mat3, rates: [f32; 3]) -> Mat3 {
    Mat3::from_cols(frame.x_axis * rates[0], frame.y_axis * rates[1], frame.z_axis * rates[2]) * frame.transpose()
}

/// Primary and secondary directions of eight vertices, lane by lane.
#[derive(Clone, Debug)]
pub(super) struct StretchAxes {
    first: [f32x8; 3],
    second: [f32x8; 3],
}

impl StretchAxes {
    /// The axes of all vertices in blocks; the last block is filled up with zeros.
    pub fn blocks(frames: &[Mat3]) -> Vec<Self> {
        let lanes = |block: &[Mat3], axis: fn(&Mat3) -> Vec3| {
            std::array::from_fn(|k| f32x8::from(std::array::from_fn(|i| block.get(i).map_or(0.0, |f| axis(f)[k]))))
        };
        let block = |b: &[Mat3]| Self { first: lanes(b, |f| f.x_axis), second: lanes(b, |f| f.y_axis) };
        frames.chunks(LANES).map(block).collect()
    }

    /// The transformations of the block from the logarithms of the rates: [`stretch_along`], lane by lane. As the tensors
    /// of the three axes sum to the identity, `T = c3 I + (c1 − c3) d1 d1ᵀ + (c2 − c3) d2 d2ᵀ`.
    pub fn stretch(&self, logs: &[[f32; LANES]; 3], out: &mut [Mat3]) {
        self.with_rates(logs.map(|l| f32x8::from(l).exp()), out);
    }

    /// The same from the logarithms of the primary rates alone, where the others follow from them.
    pub fn stretch_by_primary(&self, volume: VolumeMode, logs: [f32; LANES], out: &mut [Mat3]) {
        let first = f32x8::from(logs).exp();
        let one = f32x8::from(1.0);
        let rates = match volume {
            VolumeMode::Secondary => [first, one / first, one],
            _ => {
                let other = one / first.sqrt();
                [first, other, other]
            }
        };
        self.with_rates(rates, out);
    }

    fn with_rates(&self, [c1, c2, c3]: [f32x8; 3], out: &mut [Mat3]) {
        let (a, b) = (c1 - c3, c2 - c3);
        let ([x, y, z], [u, v, w]) = (self.first, self.second);
        let (ax, ay, az) = (a * x, a * y, a * z);
        let (bu, bv, bw) = (b * u, b * v, b * w);
        let [xx, yy, zz, xy, yz, zx] = [
            ax * x + bu * u + c3,
            ay * y + bv * v + c3,
            az * z + bw * w + c3,
            ax * y + bu * v,
            ay * z + bv * w,
            az * x + bw * u,
        ]
        .map(f32x8::to_array);
        for (i, matrix) in out.iter_mut().enumerate() {
            *matrix = Mat3::from_cols(
                Vec3::new(xx[i], xy[i], zx[i]),
                Vec3::new(xy[i], yy[i], yz[i]),
                Vec3::new(zx[i], yz[i], zz[i]),
            );
        }
    }
}
