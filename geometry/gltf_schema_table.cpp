#include <algorithm>
#include <array>

#include "geometry/gltf_schema.h"

namespace parity::gltf {

Field Field::required() const {
  Field field = *this;
  field.is_required = true;
  return field;
}

Field Field::list(std::size_t at_least_items, std::size_t at_most_items) const {
  Field field = *this;
  field.array = true;
  field.least = at_least_items;
  field.most = at_most_items;
  return field;
}

Field Field::distinct() const {
  Field field = *this;
  field.is_distinct = true;
  return field;
}

Field Field::at_least(double value) const {
  Field field = *this;
  field.low = value;
  return field;
}

Field Field::at_most(double value) const {
  Field field = *this;
  field.high = value;
  return field;
}

Field Field::above(double value) const {
  Field field = at_least(value);
  field.low_is_open = true;
  return field;
}

namespace {

using Shape = std::vector<Field>;
constexpr double largest_int = 2147483647.0;
constexpr double largest_size = 9007199254740992.0;  // 2^53: exact in JSON
constexpr double largest_uv_set = 15.0;

Field flag(std::string name) { return {.name = std::move(name), .kind = Field::Kind::boolean}; }
Field number(std::string name) { return {.name = std::move(name), .kind = Field::Kind::number}; }
Field text(std::string name) { return {.name = std::move(name), .kind = Field::Kind::text}; }
/// What the parser keeps in 32 bits: all of sparse accessors and extensions, too.
Field integer(std::string name) {
  return {.name = std::move(name), .kind = Field::Kind::integer, .low = 0, .high = largest_int};
}
Field size(std::string name) {
  return {.name = std::move(name), .kind = Field::Kind::integer, .low = 0, .high = largest_size};
}
Field one_of(std::string name, std::vector<int> values) {
  return {.name = std::move(name),
          .kind = Field::Kind::integer,
          .high = largest_int,
          .numbers = std::move(values)};
}
Field one_of(std::string name, std::vector<std::string> values) {
  return {.name = std::move(name), .kind = Field::Kind::text, .words = std::move(values)};
}
Field index(std::string name, std::string target) {
  return {.name = std::move(name),
          .kind = Field::Kind::integer,
          .low = 0,
          .high = largest_int,
          .target = std::move(target)};
}
Field indices_by_name(std::string name) {
  return {.name = std::move(name),
          .kind = Field::Kind::reference_map,
          .low = 0,
          .high = largest_int,
          .target = "accessors"};
}
Field object(std::string name, const Shape& shape) {
  return {.name = std::move(name), .kind = Field::Kind::object, .shape = &shape};
}
Field unit(std::string name) { return number(std::move(name)).at_least(0).at_most(1); }

// The shapes, inner ones first. In the order of the specification's "Properties Reference".

const Shape empty_shape{};

const Shape sparse_indices_shape{index("bufferView", "bufferViews").required(),
                                 integer("byteOffset"),
                                 one_of("componentType", std::vector{5121, 5123, 5125}).required()};
const Shape sparse_values_shape{index("bufferView", "bufferViews").required(),
                                integer("byteOffset")};
const Shape sparse_shape{integer("count").at_least(1).required(),
                         object("indices", sparse_indices_shape).required(),
                         object("values", sparse_values_shape).required()};
const Shape accessor_shape{
    index("bufferView", "bufferViews"),
    size("byteOffset"),
    one_of("componentType", std::vector{5120, 5121, 5122, 5123, 5125, 5126}).required(),
    flag("normalized"),
    size("count").at_least(1).required(),
    one_of("type",
           std::vector<std::string>{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"})
        .required(),
    number("min").list(1, 16),
    number("max").list(1, 16),
    object("sparse", sparse_shape),
    text("name")};

const Shape channel_target_shape{index("node", "nodes"), text("path").required()};
const Shape channel_shape{integer("sampler").required(),
                          object("target", channel_target_shape).required()};
const Shape animation_sampler_shape{
    index("input", "accessors").required(), index("output", "accessors").required(),
    one_of("interpolation", std::vector<std::string>{"LINEAR", "STEP", "CUBICSPLINE"})};
const Shape animation_shape{object("channels", channel_shape).list(1).required(),
                            object("samplers", animation_sampler_shape).list(1).required(),
                            text("name")};

const Shape asset_shape{text("version").required(), text("minVersion"), text("generator")};

const Shape meshopt_view_shape{
    index("buffer", "buffers").required(),
    integer("byteOffset"),
    integer("byteLength").at_least(1).required(),
    integer("byteStride").at_least(1).at_most(256).required(),
    integer("count").at_least(1).required(),
    one_of("mode", std::vector<std::string>{"ATTRIBUTES", "TRIANGLES", "INDICES"}).required(),
    one_of("filter", std::vector<std::string>{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"})};
const Shape view_extensions{object("EXT_meshopt_compression", meshopt_view_shape)};
const Shape view_shape{
    index("buffer", "buffers").required(),       size("byteOffset"),
    size("byteLength").at_least(1).required(),   integer("byteStride").at_least(4).at_most(252),
    one_of("target", std::vector{34962, 34963}), object("extensions", view_extensions)};

const Shape meshopt_buffer_shape{flag("fallback")};
const Shape buffer_extensions{object("EXT_meshopt_compression", meshopt_buffer_shape)};
const Shape buffer_shape{text("uri"), size("byteLength").at_least(1).required(),
                         object("extensions", buffer_extensions)};

const Shape perspective_shape{number("aspectRatio").above(0),
                              number("yfov").above(0).at_most(3.14159).required(),
                              number("zfar").above(0), number("znear").above(0).required()};
const Shape orthographic_shape{number("xmag").required(), number("ymag").required(),
                               number("zfar").above(0).required(),
                               number("znear").at_least(0).required()};
const Shape camera_shape{
    one_of("type", std::vector<std::string>{"perspective", "orthographic"}).required(),
    object("perspective", perspective_shape), object("orthographic", orthographic_shape),
    text("name")};

const Shape image_shape{text("uri"), text("mimeType"), index("bufferView", "bufferViews"),
                        text("name")};

const Shape transform_shape{number("offset").list(2, 2), number("rotation"),
                            number("scale").list(2, 2),
                            integer("texCoord").at_most(largest_uv_set)};
const Shape info_extensions{object("KHR_texture_transform", transform_shape)};

Shape texture_info(std::vector<Field> more = {}) {
  Shape shape{index("index", "textures").required(), integer("texCoord").at_most(largest_uv_set),
              object("extensions", info_extensions)};
  shape.insert(shape.end(), more.begin(), more.end());
  return shape;
}

const Shape info_shape = texture_info();
const Shape normal_info_shape = texture_info({number("scale")});
const Shape occlusion_info_shape = texture_info({unit("strength")});
const Shape pbr_shape{unit("baseColorFactor").list(4, 4), object("baseColorTexture", info_shape),
                      unit("metallicFactor"), unit("roughnessFactor"),
                      object("metallicRoughnessTexture", info_shape)};
const Shape emissive_strength_shape{number("emissiveStrength").at_least(0)};
const Shape specular_glossiness_shape{
    unit("diffuseFactor").list(4, 4), unit("specularFactor").list(3, 3), unit("glossinessFactor"),
    object("diffuseTexture", info_shape), object("specularGlossinessTexture", info_shape)};
const Shape clearcoat_shape{unit("clearcoatFactor"), object("clearcoatTexture", info_shape),
                            unit("clearcoatRoughnessFactor"),
                            object("clearcoatRoughnessTexture", info_shape),
                            object("clearcoatNormalTexture", normal_info_shape)};
const Shape specular_shape{unit("specularFactor"), object("specularTexture", info_shape),
                           number("specularColorFactor").at_least(0).list(3, 3),
                           object("specularColorTexture", info_shape)};
const Shape ior_shape{number("ior").at_least(0)};
const Shape sheen_shape{unit("sheenColorFactor").list(3, 3),
                        object("sheenColorTexture", info_shape), unit("sheenRoughnessFactor"),
                        object("sheenRoughnessTexture", info_shape)};
const Shape anisotropy_shape{unit("anisotropyStrength"), number("anisotropyRotation"),
                             object("anisotropyTexture", info_shape)};
const Shape iridescence_shape{unit("iridescenceFactor"),
                              object("iridescenceTexture", info_shape),
                              number("iridescenceIor").at_least(1),
                              number("iridescenceThicknessMinimum").at_least(0),
                              number("iridescenceThicknessMaximum").at_least(0),
                              object("iridescenceThicknessTexture", info_shape)};
const Shape transmission_shape{unit("transmissionFactor"),
                               object("transmissionTexture", info_shape)};
const Shape volume_shape{
    number("thicknessFactor").at_least(0), object("thicknessTexture", info_shape),
    number("attenuationDistance").above(0), unit("attenuationColor").list(3, 3)};
const Shape material_extensions{
    object("KHR_materials_anisotropy", anisotropy_shape),
    object("KHR_materials_clearcoat", clearcoat_shape),
    object("KHR_materials_ior", ior_shape),
    object("KHR_materials_iridescence", iridescence_shape),
    object("KHR_materials_sheen", sheen_shape),
    object("KHR_materials_specular", specular_shape),
    object("KHR_materials_transmission", transmission_shape),
    object("KHR_materials_volume", volume_shape),
    object("KHR_materials_unlit", empty_shape),
    object("KHR_materials_emissive_strength", emissive_strength_shape),
    object("KHR_materials_pbrSpecularGlossiness", specular_glossiness_shape)};
const Shape material_shape{text("name"),
                           object("pbrMetallicRoughness", pbr_shape),
                           object("normalTexture", normal_info_shape),
                           object("occlusionTexture", occlusion_info_shape),
                           object("emissiveTexture", info_shape),
                           unit("emissiveFactor").list(3, 3),
                           one_of("alphaMode", std::vector<std::string>{"OPAQUE", "MASK", "BLEND"}),
                           number("alphaCutoff").at_least(0),
                           flag("doubleSided"),
                           object("extensions", material_extensions)};

const Shape draco_shape{
    index("bufferView", "bufferViews").required(),
    Field{.name = "attributes", .kind = Field::Kind::integer_map, .low = 0, .high = largest_int}
        .required()};
const Shape primitive_extensions{object("KHR_draco_mesh_compression", draco_shape)};
const Shape primitive_shape{
    indices_by_name("attributes").required(), index("indices", "accessors"),
    index("material", "materials"),           integer("mode").at_most(6),
    indices_by_name("targets").list(0),       object("extensions", primitive_extensions)};
const Shape mesh_shape{object("primitives", primitive_shape).list(1).required(),
                       number("weights").list(0), text("name")};

const Shape node_light_shape{index("light", "lights").required()};
const Shape instancing_shape{indices_by_name("attributes").required()};
const Shape node_extensions{object("KHR_lights_punctual", node_light_shape),
                            object("EXT_mesh_gpu_instancing", instancing_shape)};
const Shape node_shape{index("camera", "cameras"),
                       index("children", "nodes").list(0).distinct(),
                       index("skin", "skins"),
                       number("matrix").list(16, 16),
                       index("mesh", "meshes"),
                       number("rotation").list(4, 4),
                       number("scale").list(3, 3),
                       number("translation").list(3, 3),
                       number("weights").list(0),
                       text("name"),
                       object("extensions", node_extensions)};

const Shape sampler_shape{one_of("magFilter", std::vector{9728, 9729}),
                          one_of("minFilter", std::vector{9728, 9729, 9984, 9985, 9986, 9987}),
                          one_of("wrapS", std::vector{33071, 33648, 10497}),
                          one_of("wrapT", std::vector{33071, 33648, 10497})};
const Shape scene_shape{index("nodes", "nodes").list(0).distinct(), text("name")};
const Shape skin_shape{index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                       index("joints", "nodes").list(1).distinct().required(), text("name")};

const Shape other_source_shape{index("source", "images")};
const Shape texture_extensions{object("EXT_texture_webp", other_source_shape),
                               object("KHR_texture_basisu", other_source_shape)};
const Shape texture_shape{index("sampler", "samplers"), index("source", "images"),
                          object("extensions", texture_extensions)};

const Shape spot_shape{number("innerConeAngle").at_least(0).at_most(1.5708),
                       number("outerConeAngle").above(0).at_most(1.5708)};
const Shape light_shape{number("color").at_least(0).list(3, 3),
                        number("intensity").at_least(0),
                        number("range").above(0),
                        text("type").required(),
                        object("spot", spot_shape),
                        text("name")};
const Shape lights_shape{object("lights", light_shape).list(0).required()};
const Shape extensions_of_root{object("KHR_lights_punctual", lights_shape)};

const Shape root{object("asset", asset_shape).required(),
                 text("extensionsUsed").list(0),
                 text("extensionsRequired").list(0),
                 object("accessors", accessor_shape).list(0),
                 object("animations", animation_shape).list(0),
                 object("bufferViews", view_shape).list(0),
                 object("buffers", buffer_shape).list(0),
                 object("cameras", camera_shape).list(0),
                 object("images", image_shape).list(0),
                 object("materials", material_shape).list(0),
                 object("meshes", mesh_shape).list(0),
                 object("nodes", node_shape).list(0),
                 object("samplers", sampler_shape).list(0),
                 index("scene", "scenes"),
                 object("scenes", scene_shape).list(0),
                 object("skins", skin_shape).list(0),
                 object("textures", texture_shape).list(0),
                 object("extensions", extensions_of_root)};

// The last two need nothing done: their base material, and the JSON as it stands, is what counts.
constexpr std::array supported_extensions{"EXT_mesh_gpu_instancing",
                                          "EXT_meshopt_compression",
                                          "KHR_draco_mesh_compression",
                                          "KHR_lights_punctual",
                                          "KHR_materials_anisotropy",
                                          "KHR_materials_clearcoat",
                                          "KHR_materials_emissive_strength",
                                          "KHR_materials_ior",
                                          "KHR_materials_iridescence",
                                          "KHR_materials_pbrSpecularGlossiness",
                                          "KHR_materials_sheen",
                                          "KHR_materials_specular",
                                          "KHR_materials_transmission",
                                          "KHR_materials_unlit",
                                          "KHR_materials_volume",
                                          "KHR_mesh_quantization",
                                          "KHR_texture_transform",
                                          "KHR_materials_variants"};

}  // namespace

const std::vector<Field>& root_shape() { return root; }

bool is_supported_extension(std::string_view name) {
  return std::ranges::find(supported_extensions, name) != supported_extensions.end();
}

}  // namespace parity::gltf
