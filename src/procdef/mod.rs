//! Bodies that move by themselves: local deformations, prescribed in space and time, that add up to motions of the whole.
//!
//! The method is that of Ijiri, Takayama, Yokota and Igarashi, *ProcDef: Local-to-global Deformation for Skeleton-free
//! Character Animation* (2009); section and equation numbers are that paper's.
