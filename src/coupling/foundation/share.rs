//! A body's stiffness is shared among all its contacts that push it the same way.
//!
//! Contacts that push across each other do not share. So a floor of many tiles is as soft as one of a single box, and a
//! body in a corner rests on each wall with the full stiffness.

use std::collections::BTreeMap;

use super::{ContactMaterial, FoundationContact};
use crate::math::Vec3;

/// The material of each contact: of one elastic body, or of two in series, each with its share for this contact.
pub fn materials(contacts: &[FoundationContact]) -> Vec<ContactMaterial> {
    let shares = shares(contacts);
    let side = |contact: &FoundationContact, share: [f32; 2], side: usize| {
        contact.sides[side].map(|elastic| elastic.material.share(share[side]))
    };
    let material =
        |(contact, &share): (&FoundationContact, &[f32; 2])| match (side(contact, share, 0), side(contact, share, 1)) {
            (Some(a), Some(b)) => a.against(b),
            (Some(a), None) | (None, Some(a)) => a,
            (None, None) => ContactMaterial::NONE,
        };
    contacts.iter().zip(&shares).map(material).collect()
}

/// For each contact and side, the part of the elastic body's stiffness that the contact uses, in (0, 1].
fn shares(contacts: &[FoundationContact]) -> Vec<[f32; 2]> {
    // Index of the contact, side, way out, and how much of it there is.
    type Owned = Vec<(usize, usize, Vec3, f32)>;
    let mut by_owner: BTreeMap<(u32, u32), Owned> = BTreeMap::new();
    for (index, contact) in contacts.iter().enumerate() {
        for (side, elastic) in contact.sides.iter().enumerate() {
            let Some(elastic) = elastic else { continue };
            let out = if side == 0 { contact.normal() } else { -contact.normal() };
            by_owner.entry(elastic.owner).or_default().push((index, side, out, contact.square_depth()));
        }
    }
    let mut shares = vec![[1.0; 2]; contacts.len()];
    for own in by_owner.values() {
        for &(index, side, out, amount) in own {
            let total: f32 = own.iter().map(|&(_, _, other, amount)| out.dot(other).max(0.0) * amount).sum();
            shares[index][side] = (amount / total.max(amount)).clamp(LEAST_SHARE, 1.0);
        }
    }
    shares
}

/// Less than this part of a body's stiffness is not worth dividing by.
const LEAST_SHARE: f32 = 1.0e-6;
