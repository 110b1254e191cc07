#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gpu/core/context.h"

namespace parity::tools {

/// Where, with what and when something was measured.
struct Provenance {
  std::string device;  ///< its name
  std::string driver;  ///< name and version
  std::string host;    ///< the processor
  std::string commit;  ///< of the source, as it was configured; "unknown" outside a repository
  std::string date;    ///< UTC, "2026-01-31"; of SOURCE_DATE_EPOCH if that is set
};

Provenance provenance_of(const gpu::Context& context);

/// "llvmpipe ..., Mesa 25.0.7; Xeon ...; commit 0123abc; 2026-01-31"
std::string text_of(const Provenance& provenance);
nlohmann::json json_of(const Provenance& provenance);

/// The date of an epoch, UTC; of now if `epoch` is null or no number.
std::string date_of(const char* epoch);

}  // namespace parity::tools
