//! Codes of running.

super::area! {}
