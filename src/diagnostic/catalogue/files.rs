//! Codes of files.

super::area! {}
