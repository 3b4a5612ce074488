//! Opens private rooms to the tests and measurements of this crate. Nothing in here is promised: what another
//! program needs is public in its own room.

pub mod check {
    pub use crate::check::changed_parts::recheck_program;
}

pub mod layered_chips {
    pub use crate::layered_chips::*;

    pub mod area {
        pub use crate::layered_chips::area::*;
    }
    pub mod boundary_diagram {
        pub use crate::layered_chips::boundary_diagram::*;
    }
    pub mod chip {
        pub use crate::layered_chips::chip::*;
    }
    pub mod engagement {
        pub use crate::layered_chips::engagement::largest_feed_fraction;
    }
    pub mod section_family {
        pub use crate::layered_chips::section_family::*;
    }
    pub mod stack {
        pub use crate::layered_chips::stack::*;
    }
    pub mod stl_export {
        pub use crate::layered_chips::stl_export::*;
    }
    pub mod swept_area {
        pub use crate::layered_chips::swept_area::*;
    }
}

pub mod parse {
    pub use crate::parse::agreement::compare_with_grammar;
}

pub mod surface {
    pub mod drop_cutter {
        pub use crate::surface::drop_cutter::*;
    }
    pub mod mesh_section {
        pub use crate::surface::mesh_section::*;
    }
    pub mod profile {
        pub use crate::surface::profile::*;
    }
}

pub mod transform {
    pub mod correct_ramp {
        pub use crate::transform::correct_ramp::ramp_correction::*;

        pub mod circumscribed_circle {
            pub use crate::transform::correct_ramp::circumscribed_circle::*;
        }
        pub mod ramp {
            pub use crate::transform::correct_ramp::ramp::*;
        }
        pub mod ramp_kind {
            pub use crate::transform::correct_ramp::ramp_kind::*;
        }
        pub mod ramp_limits {
            pub use crate::transform::correct_ramp::ramp_limits::*;
        }
        pub mod ramp_pillar {
            pub use crate::transform::correct_ramp::ramp_pillar::*;
        }
        pub mod ramp_passes {
            pub use crate::transform::correct_ramp::ramp_passes::*;
        }
        pub mod tool_region {
            pub use crate::transform::correct_ramp::tool_region::*;
        }
    }
    pub mod optimize_feed {
        pub use crate::transform::optimize_feed::limit::*;
        pub use crate::transform::optimize_feed::measure::*;
        pub use crate::transform::optimize_feed::plan::*;
        pub use crate::transform::optimize_feed::write::*;
    }
    pub mod unit_slips {
        pub use crate::transform::unit_slips::*;
    }
}
