//! Profiles in a vertical plane, and the path of a ball over them.
