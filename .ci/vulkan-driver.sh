# Sourced by ./demo, ./test and .ci/run: makes sure that there is a driver for wgpu, in software where there is no GPU.

# Succeeds where the Vulkan loader would find the description of a driver.
has_vulkan_driver() {
    local given="${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}"
    if [ -n "$given" ]; then
        # A list like PATH; one that exists is enough.
        local file
        while IFS= read -r file; do
            [ -e "$file" ] && return 0
        done <<<"${given//:/$'\n'}"
        return 1
    fi
    local data="${XDG_DATA_DIRS:-/usr/local/share:/usr/share}"
    local folder
    while IFS= read -r folder; do
        compgen -G "$folder/vulkan/icd.d/*.json" >/dev/null && return 0
    done <<<"/etc
/usr/local/etc
/usr/local/share
/usr/share
${XDG_CONFIG_HOME:-${HOME:-}/.config}
${XDG_DATA_HOME:-${HOME:-}/.local/share}
${data//:/$'\n'}"
    return 1
}

# Exits with 1 and a remedy where there is no driver and none can be installed.
ensure_vulkan_driver() {
    case "$(uname -s)" in
        Linux | FreeBSD) ;;
        # Metal on macOS and Direct3D 12 on Windows come with the system.
        *) return 0 ;;
    esac
    if has_vulkan_driver; then
        return 0
    fi
    if ! command -v apt-get >/dev/null; then
        cat >&2 <<'REMEDY'
No Vulkan driver was found. Install the one of your GPU, or Mesa's software driver (lavapipe):
  Fedora    dnf install mesa-vulkan-drivers vulkan-loader
  Arch      pacman -S vulkan-swrast vulkan-icd-loader
  Alpine    apk add mesa-vulkan-swrast vulkan-loader
  openSUSE  zypper install libvulkan_lvp libvulkan1
  NixOS     set hardware.graphics.enable = true;
REMEDY
        exit 1
    fi
    if [ "$(id -u)" -ne 0 ]; then
        echo 'No Vulkan driver was found. Install one: sudo apt-get install mesa-vulkan-drivers libvulkan1' >&2
        exit 1
    fi
    echo 'No Vulkan driver was found: installing the software driver of Mesa.' >&2
    apt-get update -q >&2
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends mesa-vulkan-drivers libvulkan1 >&2
    if ! has_vulkan_driver; then
        echo 'mesa-vulkan-drivers was installed and still no driver description is in /usr/share/vulkan/icd.d.' >&2
        exit 1
    fi
}
