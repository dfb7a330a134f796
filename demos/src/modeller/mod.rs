//! A small modeller: shapes given by signed distances are blended, meshed, and the mesh is made
//! even. The assets of the demos come from here.

pub mod blend;
pub mod camel;
pub mod field;
pub mod head;
pub mod icosphere;
pub mod mend;
pub mod mesh;
pub mod obj;
pub mod quality;
pub mod relax;
pub mod remesh;
pub mod rock;
pub mod shapes;
pub mod smooth;
pub mod soft;
pub mod subdivide;
pub mod surface;
pub mod surgery;
pub mod toys;
pub mod tube;
