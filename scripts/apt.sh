# Sourced by the scripts that install packages. Runs Debian's apt, quiet unless it fails, and asks for root rights only
# if there is something to install.

is_debian_like() { command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; }

fail() {
    echo "setup.sh: $*" >&2
    exit 1
}

# Prints those of the given packages that are not installed, one per line.
missing_packages() {
    local package status
    for package in "$@"; do
        status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
        [[ $status == installed ]] || echo "$package"
    done
}

as_root=()
# need_root REASON: makes "${as_root[@]}" run commands as root.
need_root() {
    ((EUID != 0)) || return 0
    command -v sudo >/dev/null || fail "$1 needs root or sudo; as root, run: scripts/setup.sh $setup_goal"
    as_root=(sudo)
}

apt_log=$(mktemp)
trap 'rm -f "$apt_log"' EXIT
apt_updated=

apt() {
    need_root "installing packages"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 "$@" \
        </dev/null >"$apt_log" 2>&1 || { tail -n 30 "$apt_log" >&2 && return 1; }
}

# Updates the package lists, once per run.
apt_update() {
    [[ -n $apt_updated ]] || apt update || fail "apt-get could not read the package lists; see its message, then run this again."
    apt_updated=yes
}

# install_packages PACKAGES...: installs those that are missing.
install_packages() {
    local missing
    mapfile -t missing < <(missing_packages "$@")
    ((${#missing[@]})) || return 0
    echo "Installing ${#missing[@]} packages: ${missing[*]}"
    apt_update
    apt install -y --no-install-recommends "${missing[@]}" ||
        fail "apt-get could not install the packages above; see its message, then run this again."
}
