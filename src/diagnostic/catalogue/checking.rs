//! Codes of checking.

super::area! {}
