//! Codes of recipe.

super::area! {}
