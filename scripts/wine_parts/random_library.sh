# Adds what Wine before version 9 lacks and every program of Rust needs: `add_random_library FOLDER`, with the prefix in
# WINEPREFIX; FOLDER is for what is compiled on the way. Needs x86_64-w64-mingw32-gcc where it is missing.
#
# Programs of Rust ask Windows for random numbers by bcryptprimitives.dll; this one passes the question on to the older library.
add_random_library() {
  local system=$WINEPREFIX/drive_c/windows/system32
  if [ -e "$system/bcryptprimitives.dll" ]; then return; fi
  printf '%s\n' '#include <windows.h>' 'BOOLEAN NTAPI SystemFunction036(PVOID, ULONG);' \
    '__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T size)' \
    '{ return SystemFunction036(data, (ULONG)size); }' >"$1/random.c"
  x86_64-w64-mingw32-gcc -shared -o "$system/bcryptprimitives.dll" "$1/random.c" -ladvapi32
}
