# Sourced by setup.sh: installs software Vulkan, so that every test runs on machines with any GPU or none.
#
# The tests name their drivers (tests/vulkan_test.cmake) and need two software ones: with ray query (lavapipe of Mesa
# 25.0) and without (Mesa 22.3). Debian 12 has 22.3, and 25.0 in its backports. 22.3 is unpacked into build/mesa-22.3.
# 25.0 is installed, so that the tool has a device as well. But on a machine with a working GPU, installing could
# replace its driver, which may be in the same package: there 25.0 is unpacked too, into build/mesa-25.0.

wanted_mesa=25.0
old_mesa=22.3

# Whether there is a Vulkan device other than a software one.
gpu_answers() {
    local devices
    devices=$(timeout 60 vulkaninfo --summary 2>/dev/null || true)
    grep -qE 'deviceType *= *PHYSICAL_DEVICE_TYPE_(DISCRETE|INTEGRATED|VIRTUAL)_GPU' <<<"$devices"
}

is_debian_12() { (. /etc/os-release && [[ $ID == debian && ${VERSION_CODENAME:-} == bookworm ]]); }

installed_mesa() { dpkg-query -W -f='${Version}' mesa-vulkan-drivers 2>/dev/null || true; }

# Prints the newest version of Mesa that apt offers, if it is at least 25.0.
offered_mesa() {
    local version
    version=$(apt-cache madison mesa-vulkan-drivers | awk '{print $3; exit}')
    dpkg --compare-versions "${version:-0}" ge "$wanted_mesa" && echo "$version" || true
}

# Adds Debian 12's backports, with the mirror and key of the system's own sources.
add_backports() {
    local mirror source key
    need_root "adding Debian 12's backports"
    IFS='|' read -r mirror source < <(apt-get indextargets --format '$(CODENAME)/$(ORIGIN)/$(COMPONENT)|$(REPO_URI)|$(SOURCESENTRY)' \
        'Created-By: Packages' | sed -n 's,^bookworm/Debian/main|,,p' | head -n 1) || true
    [[ -n ${mirror:-} ]] || fail "software Vulkan with ray query comes from Debian 12's backports, but apt's sources name no Debian 12 mirror to take them from."
    key=$(grep -ioPm 1 '^[^#]*signed-by[:=]\s*\K/[^]\s]+' "${source%:*}" || true)
    printf '%s\n' "Types: deb" "URIs: $mirror" "Suites: bookworm-backports" "Components: main" ${key:+"Signed-By: $key"} |
        "${as_root[@]}" tee /etc/apt/sources.list.d/probegi-backports.sources >/dev/null
    apt_updated=
    apt_update
}

unpacked_driver() { ls build/mesa-"$1"/usr/lib/*/libvulkan_lvp.so 2>/dev/null || true; }

# Whether a version is unpacked and all its libraries are found.
is_unpacked() {
    local driver
    driver=$(unpacked_driver "$1")
    [[ -n $driver ]] && ! grep -q 'not found' <<<"$(ldd "$driver")"
}

# unpack_mesa NAME VERSION: unpacks a software driver into build/mesa-NAME, without installing it.
unpack_mesa() {
    local name=$1 version=$2 folder=build/mesa-$1 driver package dependencies
    echo "Unpacking Mesa $version, software Vulkan for the tests, into $folder"
    rm -rf "$folder"
    mkdir -p "$folder"
    # As the current user, since apt's own user may not write to the folder.
    (cd "$folder" && apt-get -q -o APT::Sandbox::User="$(id -un)" download "mesa-vulkan-drivers=$version") >"$apt_log" 2>&1 ||
        { tail -n 30 "$apt_log" >&2 && fail "apt-get could not download Mesa $version."; }
    package=$(ls "$folder"/*.deb)
    mapfile -t dependencies < <(dpkg-deb -f "$package" Depends | tr ',' '\n' | grep -oE '^ *(lib|zlib)[^ :|]+' | tr -d ' ')
    install_packages "${dependencies[@]}"
    dpkg-deb -x "$package" "$folder"
    rm "$package"
    driver=$(unpacked_driver "$name")
    [[ -n $driver ]] || fail "Mesa $version holds no software Vulkan for this processor."
    ! ldd "$driver" | grep 'not found' || fail "Mesa $version's driver lacks the libraries above."
}

expect_ray_query() {
    local extension devices
    devices=$(timeout 60 vulkaninfo 2>/dev/null || true)
    for extension in ray_query acceleration_structure ray_tracing_pipeline; do
        grep -q "VK_KHR_$extension " <<<"$devices" ||
            fail "Mesa $(installed_mesa) was installed, but no Vulkan device offers VK_KHR_$extension."
    done
}

setup_newer_mesa() {
    local installed
    installed=$(installed_mesa)
    if dpkg --compare-versions "${installed:-0}" ge "$wanted_mesa" || is_unpacked "$wanted_mesa"; then return; fi
    echo "Software Vulkan with ray query, Mesa $wanted_mesa, comes from Debian 12's backports (/etc/apt/sources.list.d/probegi-backports.sources)"
    apt_update
    [[ -n $(offered_mesa) ]] || add_backports
    [[ -n $(offered_mesa) ]] || fail "Debian 12's backports offer no Mesa $wanted_mesa, which the tests need as software Vulkan with ray query."
    if gpu_answers; then
        unpack_mesa "$wanted_mesa" "$(offered_mesa)"
        return
    fi
    apt install -y --no-install-recommends -t bookworm-backports mesa-vulkan-drivers ||
        fail "apt-get could not install mesa-vulkan-drivers from Debian 12's backports; see its message."
    expect_ray_query
}

setup_older_mesa() {
    local version
    if is_unpacked "$old_mesa"; then return; fi
    find_old_mesa() { apt-cache madison mesa-vulkan-drivers | awk -v old="$old_mesa" 'index($3, old) == 1 {print $3; exit}'; }
    version=$(find_old_mesa)
    if [[ -z $version ]]; then
        apt_update
        version=$(find_old_mesa)
    fi
    [[ -n $version ]] || fail "apt offers no Mesa $old_mesa, which the tests use as the Vulkan device without ray query."
    unpack_mesa "$old_mesa" "$version"
}

setup_software_vulkan() {
    if is_debian_12; then
        setup_newer_mesa
        setup_older_mesa
    else
        install_packages mesa-vulkan-drivers
    fi
}
