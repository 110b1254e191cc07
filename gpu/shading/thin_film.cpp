#include "gpu/shading/thin_film.h"

#include "gpu/shading/query_map.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<vec3> thin_film(Context& context, std::span<const FilmQuery> queries) {
  return query_map<FilmArgs, vec3>(context, shaders::shading_thin_film_comp, queries);
}

}  // namespace parity::gpu
