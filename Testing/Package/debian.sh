#!/usr/bin/env bash
# Builds the Debian packages, in build/debian, checks what is in them, and uses them.
#
#   debian.sh          unpacked into a folder
#   debian.sh --full   also installed by apt in bare systems; needs root, mmdebstrap, and Debian's archive
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
full=
case ${1:-} in
  '') ;;
  --full) full=1 ;;
  *)
    echo "usage: $0 [--full]" >&2
    exit 2
    ;;
esac
debian=$root/build/debian
version=$(sed -n 's/^project(Atria VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
architecture=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
use=$root/Testing/Package/use-packages.sh

fail() {
  echo "$*" >&2
  exit 1
}

build_packages() {
  rm -rf "$debian"
  local preset
  for preset in package package-paraview; do
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset"
    cpack --config "build/$preset/CPackConfig.cmake" -B "$debian"
  done
  rm -rf "$debian/_CPack_Packages"
}

# contents PACKAGE: its files, without the leading dot
contents() {
  dpkg-deb --fsys-tarfile "$debian/$1"_*.deb | tar -t | sed 's/^\.//' | grep -v '/$'
}

# holds PACKAGE PATTERN...: each pattern matches a file of it, and each file a pattern
holds() {
  local package=$1 pattern listed
  shift
  set -- "$@" "/usr/share/doc/$package/copyright" "/usr/share/doc/$package/changelog.Debian.gz"
  listed=$(contents "$package")
  for pattern in "$@"; do
    grep -qE "^$pattern$" <<<"$listed" || fail "$package lacks $pattern"
  done
  ! grep -vE "^($(IFS='|'; echo "$*"))$" <<<"$listed" || fail "$package holds what it should not"
}

check_contents() {
  local lib=/usr/lib/$architecture short=${version%.*} python=/usr/lib/python3/dist-packages
  holds "libatria$short" "$lib/libAtria[A-Za-z]+\.so\.$short" "$lib/libAtria[A-Za-z]+\.so\.$version"
  holds libatria-dev "/usr/include/atria/.*\.h" "$lib/libAtria[A-Za-z]+\.so" "$lib/cmake/Atria/.*\.cmake" "$lib/vtk/.*\.txt"
  holds atria /usr/bin/atria /usr/share/man/man1/atria.1.gz /usr/share/bash-completion/completions/atria \
    /usr/share/zsh/site-functions/_atria /usr/share/fish/vendor_completions.d/atria.fish
  holds atria-assimp /usr/libexec/atria/atria-assimp
  holds python3-atria "$python/atria/.*" "$python/atria-$version.dist-info/METADATA"
  holds atria-doc "/usr/share/doc/atria-doc/.*\.md" "/usr/share/doc/atria-doc/.*"
  holds paraview-atria /usr/bin/paraview.conf "$lib/paraview-5.11/plugins/atria.xml" "$lib/paraview-5.11/plugins/Atria/.*\.so"
  holds python3-atria-paraview "$python/atria/.*" "$python/atria-$version.dist-info/METADATA"

  # No file is in two packages, but for those of Python, which conflict.
  local twice
  twice=$(for package in "libatria$short" libatria-dev atria atria-assimp python3-atria atria-doc paraview-atria; do
    contents "$package"
  done | sort | uniq -d)
  [ -z "$twice" ] || fail "in two packages: $twice"
}

# What is installed by a build is in its packages.
check_nothing_is_left_out() {
  local installed
  installed=$(mktemp -d)
  DESTDIR=$installed cmake --install build/package >/dev/null
  (cd "$installed" && find . -type f -o -type l) | sed 's/^\.//' | sort >"$debian/installed.txt"
  rm -rf "$installed"
  for package in "libatria${version%.*}" libatria-dev atria atria-assimp python3-atria atria-doc; do contents "$package"; done |
    sort | diff - "$debian/installed.txt" || fail "packages and installation differ"
  rm "$debian/installed.txt"
}

use_unpacked() {
  local archive name paraview=${ATRIA_PARAVIEW_PREFIX:-/opt/atria-paraview}
  for archive in "$debian"/*.deb; do
    name=$(basename "$archive")
    case $name in
      paraview-atria_* | python3-atria-paraview_*) dpkg-deb -x "$archive" "$debian/unpacked-paraview" ;;
      atria-doc_*) for folder in unpacked unpacked-paraview; do dpkg-deb -x "$archive" "$debian/$folder"; done ;;
      *) dpkg-deb -x "$archive" "$debian/unpacked" ;;
    esac
  done
  "$use" vtk "$debian/unpacked"
  # The plugin's panels need libraries of ParaView's window, which an installed ParaView has where the loader looks.
  LD_LIBRARY_PATH=$(echo "$paraview"/usr/lib/*-linux-gnu) ATRIA_PVPYTHON=$paraview/usr/bin/pvpython "$use" paraview "$debian/unpacked-paraview"
  rm -rf "$debian/unpacked" "$debian/unpacked-paraview"
}

# in_bare_system WHAT PACKAGE...: Debian with nothing but apt, into which the packages, and others by name, are installed
in_bare_system() {
  local what=$1
  shift
  mmdebstrap --variant=apt --format=null \
    --customize-hook="mkdir \"\$1/atria\" && cp $debian/*.deb $use \"\$1/atria\"" \
    --chrooted-customize-hook="cd /atria && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $* &&
      bash use-packages.sh $what" \
    bookworm
}

build_packages
check_contents
check_nothing_is_left_out
use_unpacked
if [ -n "$full" ]; then
  in_bare_system vtk ./libatria0*.deb ./libatria-dev_*.deb ./atria_*.deb ./atria-assimp_*.deb ./python3-atria_*.deb ./atria-doc_*.deb g++ cmake make
  in_bare_system paraview ./libatria0*.deb ./atria_*.deb ./paraview-atria_*.deb ./python3-atria-paraview_*.deb ./atria-doc_*.deb
fi
echo "The packages are good:"
ls "$debian"
