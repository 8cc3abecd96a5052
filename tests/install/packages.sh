# shellcheck shell=bash
# Debian packages that Tandem needs, and functions that install them. ./test and ./demo source this file.

# Entries "package: purpose". All these packages are in Debian 12.
# shellcheck disable=SC2034  # used by the scripts that source this file
TANDEM_PACKAGES=(
  "g++: compiles C++23"
  "cmake: configures the build"
  "ninja-build: runs the build"
  "ccache: makes the second build fast"
  "pkg-config: lets CMake find installed libraries"
  "libeigen3-dev: vectors and matrices of the control laws"
  "libprotobuf-dev: encodes datagrams, reads scenes"
  "protobuf-compiler: turns proto/schema/*.proto into C++"
  "libspdlog-dev: log lines for people"
  "libcli11-dev: command lines and --help"
  "nlohmann-json3-dev: writes the JSON reports"
  "libhdf5-dev: exports recordings as HDF5"
  "libsqlite3-dev: the index of recordings"
  "libqhull-dev: convex hulls of motions, for scores"
  "libasio-dev: the control connection's sockets and timers"
  "libboost-dev: HTTP and WebSocket of tandem-console"
  "libssl-dev: TLS of the control connection, keys, SHA-256 of traces"
  "libsodium-dev: keys of datagrams, and their cipher for processors without AES"
  "libzstd-dev: compresses recordings"
  "zlib1g-dev: checksums of recordings"
  "prometheus-cpp-dev: writes the server's metrics"
  "libgrpc++-dev: talks to etcd, the directory of several servers"
  "protobuf-compiler-grpc: turns etcd's interface into C++"
  "libusb-1.0-0-dev: talks to USB devices"
  "libhidapi-dev: talks to HID devices"
  "libudev-dev: finds devices and notices plugging"
  "umockdev: emulated USB and HID devices for tests"
  "libgtest-dev: unit and simulation tests"
  "nodejs: runs the second decoder of datagrams"
)
if [[ "$(dpkg --print-architecture 2>/dev/null)" == amd64 ]]; then
  TANDEM_PACKAGES+=("libipsec-mb-dev: seals datagrams with AES")  # in Debian for amd64 only
fi

# Further packages of ./test that ./demo does not need.
# shellcheck disable=SC2034
TANDEM_PACKAGES_TEST=(
  "clang-format-19: compares the sources with .clang-format"
  "clang-tidy-19: checks the sources for frequent mistakes"
  "doxygen: API documents of the public headers"
  "valgrind: counts instructions"
  "etcd-server: the directory of several servers, compared with its model"
  "etcd-client: reads what the directory wrote"
  "strace: slows the disks of etcd"
  "faketime: sets the wall clock of one server"
  "openssl: certificates of a service that is tried"
)

# Further packages of the label web. Without them its tests are skipped.
# shellcheck disable=SC2034
TANDEM_PACKAGES_WEB=(
  "npm: installs the packages that build the page of tandem-console"
  "chromium: shows the page in tests"
)

# Further packages of ./test --full, --nightly and --bench. Without them the default ./test lists what it did not run.
# shellcheck disable=SC2034
TANDEM_PACKAGES_FULL=(
  "clang-19: second compiler that must decide as g++ does"
  "faketime: makes wall clocks jump"
  "debootstrap: a fresh Debian to install the packages into"
  "iproute2: two machines with a cable between them, as network namespaces"
  "lintian: judges the Debian packages"
  "dpkg-dev: builds the Debian packages"
  "file: tells programs from texts when packages are built"
  "man-db: checks the manual pages"
  "systemd: judges the service's unit"
  "libxml2-utils: checks the JUnit files"
  "python3-h5py: reads exported HDF5 files"
  "octave: reads them too"
  "libenet-dev: a package that the benchmark peers compares with"
  "libzmq3-dev: the same"
  "cyclonedds-dev: the same"
  "cyclonedds-tools: its compiler of message definitions"
)

# Further packages of ./test --fuzz.
# shellcheck disable=SC2034
TANDEM_PACKAGES_FUZZ=(
  "clang-19: compiles the fuzz targets"
  "libclang-rt-19-dev: libFuzzer and sanitizers of that compiler"
)

# Further packages of ./test --vm: the virtual machine and the contents of its small system.
# shellcheck disable=SC2034
TANDEM_PACKAGES_VM=(
  "qemu-system-x86: runs the virtual machine"
  "busybox-static: the commands inside it"
  "udev: names the devices inside it"
)

packages_say() { printf '%s\n' "$@" >&2; }

# packages_missing "name: reason" ...: prints the entries whose package is not installed.
packages_missing() {
  local entry
  for entry in "$@"; do
    if [[ "$(dpkg-query -W -f '${db:Status-Status}' "${entry%%:*}" 2>/dev/null)" != installed ]]; then
      printf '%s\n' "$entry"
    fi
  done
}

# Sets PACKAGES_BECOME to the prefix that runs a command as root; empty if the user is root.
# Fails if there is no sudo, or if it needs a password and there is no terminal.
packages_become_root() {
  PACKAGES_BECOME=()
  if [[ "$(id -u)" == 0 ]]; then return 0; fi
  command -v sudo >/dev/null || return 1
  if sudo -n true 2>/dev/null; then
    PACKAGES_BECOME=(sudo -n)
  elif [[ -t 0 && -t 2 ]]; then
    packages_say "  sudo may ask for your password."
    PACKAGES_BECOME=(sudo)
  else
    return 1
  fi
}

packages_apt() {
  "${PACKAGES_BECOME[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=120 "$@" >&2
}

# ensure_packages "name: reason" ...: installs the missing packages. Prints nothing if none is missing.
# If it cannot install them, prints the command for the user and exits with 1.
ensure_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    packages_say "Tandem builds on Debian 12 (Ubuntu 24.04 is intended, untested); this system has no apt." \
      "Install the equivalents of these yourself and build with 'cmake --workflow --preset release':"
    printf '  %s\n' "$@" >&2
    exit 1
  fi

  local missing=() names=()
  mapfile -t missing < <(packages_missing "$@")
  if ((${#missing[@]} == 0)); then return 0; fi
  names=("${missing[@]%%:*}")

  local prefix="sudo "
  if [[ "$(id -u)" == 0 ]]; then prefix=""; fi
  packages_say "Tandem needs ${#missing[@]} package(s) that are not installed:"
  local entry
  for entry in "${missing[@]}"; do printf '  %-20s %s\n' "${entry%%:*}" "${entry#*: }" >&2; done
  packages_say "To remove them again later:" "  ${prefix}apt-get remove ${names[*]}" \
    "(then '${prefix}apt-get autoremove' offers what nothing needs any more, older things too: read its list)"

  local install=(install -y --no-install-recommends "${names[@]}")
  if ! packages_become_root; then
    packages_say "They need root, and there is no sudo that works without asking. Type this, then start again:" \
      "  sudo apt-get update && sudo apt-get ${install[*]}"
    exit 1
  fi

  packages_say "Installing them now."
  # Fetch package lists only if the present ones lack a package or name versions that the archive no longer has.
  if ! apt-get -s -qq "${install[@]}" >/dev/null 2>&1 || ! packages_apt "${install[@]}"; then
    packages_say "Fetching newer package lists first."
    if ! packages_apt update || ! packages_apt "${install[@]}"; then
      packages_say "apt-get could not install them (its words are above). No network? Other package sources?" \
        "When that is mended, start again, or type:" "  ${prefix}apt-get update && ${prefix}apt-get ${install[*]}"
      exit 1
    fi
  fi
  packages_say "Installed: ${names[*]}" ""
}

# try_packages "name: reason" ...: installs the missing packages if that is possible. @return 1: some are missing
try_packages() {
  local missing=()
  mapfile -t missing < <(packages_missing "$@")
  if ((${#missing[@]} == 0)); then return 0; fi
  packages_say "Installing ${missing[*]%%:*}; tests that need them are skipped if that fails."
  packages_become_root || return 1
  packages_apt install -y --no-install-recommends "${missing[@]%%:*}" >/dev/null 2>&1 ||
    { packages_apt update >/dev/null 2>&1 && packages_apt install -y --no-install-recommends "${missing[@]%%:*}" >/dev/null 2>&1; }
}
