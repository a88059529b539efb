# Sourced by ./test and .ci/run: SwiftShader, a second Vulkan driver in software, which comes with Chromium.

# Prints the path of SwiftShader's description; fails where there is none.
find_swiftshader() {
    local folder
    # Debian, Arch and Alpine; Fedora; Google's own package.
    for folder in /usr/lib/chromium /usr/lib64/chromium-browser /opt/google/chrome; do
        if [ -e "$folder/vk_swiftshader_icd.json" ]; then
            echo "$folder/vk_swiftshader_icd.json"
            return 0
        fi
    done
    return 1
}

# Makes SwiftShader the one driver, and the tests refuse any other. A VK_DRIVER_FILES that is given stays: the tests see
# whether it is SwiftShader's. Exits with 1 and a remedy where there is none and none can be installed.
use_swiftshader() {
    export CONTREJOUR_ADAPTER=SwiftShader WGPU_BACKEND=vulkan
    if [ -n "${VK_DRIVER_FILES:-}" ]; then
        return 0
    fi
    if ! find_swiftshader >/dev/null && [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then
        echo 'SwiftShader was not found: installing the part of Chromium that it comes with.' >&2
        apt-get update -q >&2
        DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends chromium-common libvulkan1 >&2
    fi
    if ! VK_DRIVER_FILES="$(find_swiftshader)"; then
        cat >&2 <<'REMEDY'
SwiftShader was not found. It comes with Chromium:
  Debian    apt-get install chromium-common libvulkan1
  Fedora    dnf install chromium vulkan-loader
  Arch      pacman -S chromium vulkan-icd-loader
  Alpine    apk add chromium vulkan-loader
Ubuntu's Chromium is a snap without it. Where it lies elsewhere: VK_DRIVER_FILES=<folder>/vk_swiftshader_icd.json
REMEDY
        exit 1
    fi
    export VK_DRIVER_FILES
}
