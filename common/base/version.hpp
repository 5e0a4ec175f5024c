#pragma once

namespace gyre {

/// Of this program, as a release is named: "0.1.0".
[[nodiscard]] const char* version();

}  // namespace gyre
