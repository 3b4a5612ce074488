# Which cargo compiles for WebAssembly: sets `target`, and the arrays `cargo` (the command) and `standard` (options that
# bring the standard library).
#
# The standard library for WebAssembly comes from rustup. Where rustup is not installed, or cannot load it, Debian's
# packages of Rust are taken, which bring its source; it is then compiled first, which takes about two minutes more.

target=wasm32-unknown-unknown
standard=()

if command -v rustup >/dev/null && rustup target add "$target"; then
  cargo=(cargo)
else
  if ! [ -e /usr/lib/rustlib/src/rust/library/std ] || ! [ -x /usr/bin/cargo ]; then
    as_root=()
    [ "$(id -u)" = 0 ] || as_root=(sudo)
    packages=(cargo-web rustc-web rust-web-src)
    if ! command -v apt-get >/dev/null || ! command -v "${as_root[0]:-apt-get}" >/dev/null; then
      echo "WebAssembly needs \`rustup target add $target\`, or Debian's packages ${packages[*]}" >&2
      exit 1
    fi
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${packages[@]}"
  fi
  # An option of unstable Rust builds the standard library; the variable lets a stable compiler take it.
  cargo=(env PATH="/usr/bin:/bin" RUSTC_BOOTSTRAP=1 /usr/bin/cargo)
  standard=(-Zbuild-std=std,panic_abort)
fi
