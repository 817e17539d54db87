#include <libmesh/attributes/known_columns.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::attribute {

namespace {

using enum scalar_type;
using enum column_use;

/// Names in PLY, OFF, XYZ and CSV, in PCD, and in LAS. A PCD field of another type is none to PCL.
constexpr known_column all_known[] = {
    {color, {{{"red", uint8}, {"red"}, {"red", uint16}}}},
    {color, {{{"green", uint8}, {"green"}, {"green", uint16}}}},
    {color, {{{"blue", uint8}, {"blue"}, {"blue", uint16}}}},
    {color, {{{"alpha", uint8}, {"alpha"}, {"alpha"}}}},
    {normal, {{{"nx"}, {"normal_x", float32}, {"NormalX"}}}},
    {normal, {{{"ny"}, {"normal_y", float32}, {"NormalY"}}}},
    {normal, {{{"nz"}, {"normal_z", float32}, {"NormalZ"}}}},
    {texture, {{{"s"}, {"u", float32}, {"texture_u"}}}},
    {texture, {{{"t"}, {"v", float32}, {"texture_v"}}}},
    {number, {{{"curvature"}, {"curvature", float32}, {"Curvature"}}}},
    {number, {{{"intensity"}, {"intensity", float32}, {"intensity", uint16}}}},
    {number, {{{"gps_time"}, {"gps_time"}, {"gps_time", float64}}}},
    {number, {{{"return_number"}, {"return_number"}, {"return_number"}}}},
    {number, {{{"number_of_returns"}, {"number_of_returns"}, {"number_of_returns"}}}},
    {number, {{{"classification"}, {"classification"}, {"classification"}}}},
    {number, {{{"user_data"}, {"user_data"}, {"user_data"}}}},
    {number, {{{"point_source_id"}, {"point_source_id"}, {"point_source_id"}}}},
    {number, {{{"scan_angle_rank"}, {"scan_angle_rank"}, {"scan_angle_rank"}}}},
    {number, {{{"scan_direction_flag"}, {"scan_direction_flag"}, {"scan_direction_flag"}}}},
    {number, {{{"edge_of_flight_line"}, {"edge_of_flight_line"}, {"edge_of_flight_line"}}}},
    {number, {{{"nir"}, {"nir"}, {"nir"}}}},
};

/// Further names, and which of the table is meant.
constexpr std::pair<std::string_view, std::string_view> also_called[] = {
    {"diffusered", "red"},
    {"diffusegreen", "green"},
    {"diffuseblue", "blue"},
    {"textureu", "s"},
    {"texturev", "t"},
    {"infrared", "nir"},
    {"numreturns", "number_of_returns"},
};

/// Small letters without underscores and without "scalar_".
[[nodiscard]] std::string spelled(std::string_view name) {
    constexpr std::string_view prefix = "scalar_";
    if (name.starts_with(prefix) && name.size() > prefix.size()) name.remove_prefix(prefix.size());
    std::string word;
    for (const char c : name)
        if (c != '_') word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return word;
}

[[nodiscard]] bool is_number(const column& c) {
    return c.role == column_role::data && !c.list_length;
}

[[nodiscard]] bool is_floating(scalar_type type) { return type >= float32; }

[[nodiscard]] bool is_packed(const column& c) {
    return is_number(c) && (c.name == packed_color || c.name == packed_color_with_alpha) &&
           (c.type == float32 || c.type == uint32 || c.type == int32);
}

[[nodiscard]] const known_column* known_of(const column& c) {
    return is_number(c) ? find_known(c.name) : nullptr;
}

/// Whether all columns of a use are there: "t" alone is hardly a texture coordinate.
[[nodiscard]] bool is_whole(const element& columns, column_use use) {
    if (use == number) return true;
    return std::ranges::all_of(all_known, [&](const known_column& k) {
        return k.use != use || std::ranges::any_of(columns.columns, [&](const column& c) {
                   return known_of(c) == &k;
               });
    });
}

/// "ply" of "ply-binary-le"; files made by a program are taken for PLY.
[[nodiscard]] std::string_view family_of(std::string_view format) {
    if (format == "laz") return "las";
    return format.empty() ? "ply" : format.substr(0, format.find('-'));
}

/// "pcd-binary" and "pcd" are PCD; "laz" is LAS.
[[nodiscard]] dialect dialect_of(std::string_view format) {
    const std::string_view family = family_of(format);
    return family == "pcd" ? dialect::pcd : family == "las" ? dialect::las : dialect::ply;
}

/// Factor from 8-bit to 16-bit color channels: 65535 / 255.
constexpr double bytes_in_word = 257.0;

[[nodiscard]] std::uint8_t nearest_byte(double value) {
    return static_cast<std::uint8_t>(value > 0.0 ? std::min(std::nearbyint(value), 255.0) : 0.0);
}

template <class T>
void put_at(column& c, std::size_t row, T value) {
    std::memcpy(c.values.data() + row * sizeof value, &value, sizeof value);
}

/// Rounded, and not beyond what the type holds; NaN becomes 0 where it is none of its values.
void put_nearest(column& c, std::size_t row, double value) {
    with_type(c.type, [&]<class T>(T) {
        if constexpr (std::is_floating_point_v<T>) {
            put_at(c, row, static_cast<T>(value));
        } else {
            constexpr auto least = static_cast<double>(std::numeric_limits<T>::min());
            constexpr auto most = static_cast<double>(std::numeric_limits<T>::max());
            const double whole = std::isnan(value) ? 0.0 : std::nearbyint(value);
            put_at(c, row,
                   whole <= least  ? std::numeric_limits<T>::min()
                   : whole >= most ? std::numeric_limits<T>::max()
                                   : static_cast<T>(whole));
        }
    });
}

}  // namespace

const known_column* find_known(std::string_view name) {
    std::string word = spelled(name);
    for (const auto& [called, meant] : also_called)
        if (word == called) word = meant;
    for (const known_column& k : all_known)
        for (const column_words& w : k.in)
            if (word == spelled(w.name)) return &k;
    return nullptr;
}

bool is_use(std::string_view name, column_use use) {
    if (use == color && (name == packed_color || name == packed_color_with_alpha)) return true;
    const known_column* const k = find_known(name);
    return k != nullptr && k->use == use;
}

std::optional<column_use> use_called(std::string_view name) {
    if (name == "normal") return normal;
    if (name == "uv") return texture;
    if (name == "color") return color;
    return std::nullopt;
}

std::optional<std::size_t> normal_axis(std::string_view name) {
    const known_column* const k = find_known(name);
    if (k == nullptr || k->use != normal) return std::nullopt;
    return static_cast<std::size_t>(k->words(dialect::ply).name.back() - 'x');
}

void look_at_ranges(const element& rows, std::vector<value_range>& seen) {
    for (const column& c : rows.columns) {
        const known_column* const k = known_of(c);
        if (k == nullptr) continue;
        const bool is_intensity = k->words(dialect::las).name == "intensity";
        if (!(k->use == color && (c.type == uint16 || is_floating(c.type))) &&
            !(is_intensity && is_floating(c.type)))
            continue;
        auto at = std::ranges::find(seen, c.name, &value_range::column);
        if (at == seen.end()) {
            constexpr double far = std::numeric_limits<double>::infinity();
            at = seen.insert(at, {.column = c.name, .min = far, .max = -far});
        }
        for (std::size_t i = 0; i < c.size(); ++i) {
            const double value = c.number(i);
            at->min = std::min(at->min, std::isnan(value) ? at->min : value);
            at->max = std::max(at->max, std::isnan(value) ? at->max : value);
            at->whole = at->whole && value == std::floor(value);
        }
    }
}

translation::translation(const element& columns, std::string_view from, std::string_view to,
                         std::span<const value_range> ranges, std::span<const std::string> drop,
                         std::span<const std::pair<std::string, std::string>> rename)
    : to_(family_of(to)),
      from_words_(dialect_of(from)),
      to_words_(dialect_of(to)),
      ranges_(ranges),
      renamed_(rename),
      is_same_(family_of(from) == to_),
      keeps_floats_(to_ == "obj" || to_ == "off" || to_ == "glb" || to_ == "3mf"),
      keeps_words_(to_ == "glb") {
    if (is_same_ && drop.empty() && rename.empty()) return;
    element chosen{.name = columns.name};
    for (const column& c : columns.columns)
        chosen.columns.push_back(
            {.name = c.name, .type = c.type, .list_length = c.list_length, .role = c.role});
    std::vector<bool> done(chosen.columns.size(), false);
    choose(chosen, drop, done);
    plan(chosen, done);
    ranges_ = {};  // these are the caller's
    renamed_ = {};
}

void translation::choose(element& columns, std::span<const std::string> drop,
                         std::vector<bool>& done) {
    const auto find = [&](const std::string& name) {
        for (std::size_t i = 0; i < columns.columns.size(); ++i)
            if (columns.columns[i].role == column_role::data && columns.columns[i].name == name)
                return i;
        throw std::invalid_argument("treeform::write: points have no property '" + name + "'");
    };
    for (const std::string& name : drop) {
        const std::vector<std::string> meant = columns.columns_called(name);
        for (const std::string& column : meant) done[find(column)] = true;
        if (meant.empty()) done[find(name)] = true;  // which says that it is not there
    }
    for (const auto& [name, source] : renamed_) {
        const std::size_t at = find(source);
        if (columns.find(name) != nullptr)
            throw std::invalid_argument("treeform::write: property '" + name + "' already exists");
        columns.columns[at].name = name;
    }
    // What is dropped is no part of anything.
    for (std::size_t i = 0; i < done.size(); ++i)
        if (done[i]) columns.columns[i].name.clear();
    changes_ = changes_ || !drop.empty() || !renamed_.empty();
}

void translation::say(std::string code, std::string text) {
    warnings_.push_back({std::move(code), std::move(text)});
}

const value_range* translation::range_of(std::string_view column) const {
    for (const auto& [name, source] : renamed_)
        if (name == column) column = source;
    const auto at = std::ranges::find(ranges_, column, &value_range::column);
    return at == ranges_.end() ? nullptr : &*at;
}

void translation::plan(const element& columns, std::vector<bool>& done) {
    if (!is_same_ && to_ != "stl") plan_colors(columns, done);  // STL has none
    for (std::size_t i = 0; i < done.size(); ++i)
        if (!done[i]) plan_column(columns, i);
    if (!narrowed_.empty())
        say("types", narrowed_ + " written as float32, the type that PCL reads");
    std::ranges::stable_sort(targets_, {}, [](const target& t) { return t.from.front(); });
}

void translation::plan_colors(const element& columns, std::vector<bool>& done) {
    std::array<std::optional<std::size_t>, 4> at{};
    for (std::size_t i = 0; i < columns.columns.size(); ++i) {
        const known_column* const k = known_of(columns.columns[i]);
        if (k == nullptr || k->use != color) continue;
        auto& place = at[static_cast<std::size_t>(k - all_known)];
        if (!place) place = i;
    }
    if (!at[0] || !at[1] || !at[2]) return plan_packed_colors(columns, done);
    std::vector<std::size_t> from{*at[0], *at[1], *at[2]};
    if (at[3]) from.push_back(*at[3]);
    std::vector<const column*> channels;
    for (std::size_t k = 0; k < 3; ++k) channels.push_back(&columns.columns[*at[k]]);
    const bool has_floats =
        std::ranges::any_of(channels, [](const column* c) { return is_floating(c->type); });
    choose_scale(channels);
    if (to_words_ == dialect::pcd) {
        const bool alpha = from.size() > 3;
        targets_.push_back(
            {.declared = {.name = std::string(alpha ? packed_color_with_alpha : packed_color),
                          .type = alpha ? uint32 : float32},
             .how = way::packed,
             .from = from});
        changes_ = true;
        for (const std::size_t i : from) done[i] = true;
        return;
    }
    if (keeps_floats_ && has_floats && scale_ == color_scale::unit) return;
    if (keeps_words_ && scale_ != color_scale::bytes) return;
    for (std::size_t k = 0; k < from.size(); ++k) {
        const column& c = columns.columns[from[k]];
        target t{
            .declared = {.name = std::string(all_known[k].words(to_words_).name), .type = c.type},
            .from = {from[k]}};
        const bool is_byte = c.type == uint8;
        if (to_words_ == dialect::las && is_floating(c.type)) {
            t.how = way::scaled;
            t.declared.type = k < 3 ? uint16 : uint8;
            t.factor = scale_ == color_scale::unit ? 65535.0 : 256.0;
            if (k == 3) t.factor = scale_ == color_scale::unit ? 255.0 : 1.0;
        } else if (to_words_ != dialect::las && !is_byte) {
            t.how = way::channel;
            t.declared.type = uint8;
        } else if (to_words_ == dialect::las && c.type == uint16 && scale_ == color_scale::bytes) {
            t.how = way::scaled;
            t.factor = 256.0;
        }
        changes_ = changes_ || t.how != way::copied || t.declared.name != c.name;
        targets_.push_back(std::move(t));
        done[from[k]] = true;
    }
}

/// Says what the values are taken for.
void translation::choose_scale(const std::vector<const column*>& channels) {
    const auto all = [&](const auto& is) { return std::ranges::all_of(channels, is); };
    const auto any = [&](const auto& is) { return std::ranges::any_of(channels, is); };
    const auto most = [&](double otherwise) {
        double greatest = -1.0;
        for (const column* c : channels) {
            const value_range* const r = range_of(c->name);
            greatest = std::max(greatest, r == nullptr ? otherwise : r->max);
        }
        return greatest;
    };
    scale_ = color_scale::bytes;
    if (any([](const column* c) { return is_floating(c->type); })) {
        if (most(1.0) > 1.0) return say("colors", "colors are rounded to whole numbers");
        scale_ = color_scale::unit;
        if (!keeps_floats_)
            say("colors", to_words_ == dialect::las
                              ? "colors from 0 to 1 are written as 0 to 65535"
                              : "colors from 0 to 1 are written as 0 to 255, rounded");
    } else if (all([](const column* c) { return c->type == uint16; })) {
        if (most(65535.0) < 256.0) {
            if (from_words_ == dialect::las || to_words_ == dialect::las)
                say("colors", "16-bit colors are all below 256 and were read as 8-bit colors");
            return;
        }
        scale_ = from_words_ == dialect::las ? color_scale::high_byte : color_scale::word;
        if (to_words_ != dialect::las && !keeps_words_)
            say("colors",
                std::string("16-bit colors are written with 8 bits: ") +
                    (from_words_ == dialect::las ? "the high ones, as LAS defines" : "rounded"));
    }
}

void translation::plan_packed_colors(const element& columns, std::vector<bool>& done) {
    if (to_words_ == dialect::pcd) return;
    for (std::size_t i = 0; i < columns.columns.size(); ++i) {
        const column& c = columns.columns[i];
        if (!is_packed(c)) continue;
        const std::size_t channels = c.name == packed_color ? 3 : 4;
        for (std::size_t k = 0; k < channels; ++k)
            targets_.push_back(
                {.declared = {.name = std::string(all_known[k].words(to_words_).name),
                              .type = uint8},
                 .how = way::unpacked,
                 .from = {i},
                 .shift = k == 3 ? 24U : static_cast<unsigned>(16 - 8 * k)});
        done[i] = true;
        changes_ = true;
        return;
    }
}

void translation::plan_column(const element& columns, std::size_t i) {
    const column& c = columns.columns[i];
    target t{
        .declared = {.name = c.name, .type = c.type, .list_length = c.list_length, .role = c.role},
        .from = {i}};
    const known_column* const k = is_same_ ? nullptr : known_of(c);
    if (k != nullptr && k->use != color && is_whole(columns, k->use)) {
        const column_words& words = k->words(to_words_);
        const bool is_free = words.name == c.name || columns.find(words.name) == nullptr;
        if (is_free) t.declared.name = words.name;
        if (is_free && words.type && *words.type != c.type) {
            if (to_words_ == dialect::las && *words.type == uint16 && is_floating(c.type)) {
                plan_intensity(t, c);
            } else if (to_words_ == dialect::pcd) {
                t.how = way::cast;
                t.declared.type = *words.type;
                if (size_of(c.type) >= 4) narrowed_ += (narrowed_.empty() ? "" : ", ") + c.name;
            }
        }
    }
    changes_ = changes_ || t.how != way::copied || t.declared.name != c.name;
    targets_.push_back(std::move(t));
}

/// LAS has whole numbers. Shares of 1 would all be 0 or 1.
void translation::plan_intensity(target& t, const column& c) {
    t.how = way::scaled;
    t.declared.type = uint16;
    const value_range* const r = range_of(c.name);
    if (r != nullptr && r->min >= 0.0 && r->max <= 1.0 && !r->whole) {
        t.factor = 65535.0;
        return say("scaled", c.name +
                                 " is from 0 to 1 and is multiplied by 65535, since LAS has whole "
                                 "numbers");
    }
    if (r == nullptr || !r->whole || r->min < 0.0 || r->max > 65535.0)
        say("scaled", c.name + " is rounded to whole numbers from 0 to 65535, as LAS stores it");
}

std::uint8_t translation::byte_of(const column& c, std::size_t row) const {
    const double value = c.number(row);
    switch (scale_) {
        case color_scale::high_byte:
            return c.type == uint16 ? static_cast<std::uint8_t>(static_cast<unsigned>(value) >> 8)
                                    : nearest_byte(value);
        case color_scale::word:
            return nearest_byte(c.type == uint16 ? value / bytes_in_word : value);
        case color_scale::unit:
            return is_floating(c.type) ? nearest_byte(value * 255.0) : nearest_byte(value);
        case color_scale::bytes:
            break;
    }
    return nearest_byte(value);
}

void translation::fill(column& to, const target& t, const element& rows) const {
    const column& first = rows.columns[t.from.front()];
    if (t.how == way::copied) {
        to.values = first.values;
        to.list_begin = first.list_begin;
        return;
    }
    const std::size_t count = first.size();
    to.values.resize(count * size_of(to.type));
    for (std::size_t row = 0; row < count; ++row) {
        switch (t.how) {
            case way::cast:
                put_nearest(to, row, first.number(row));
                break;
            case way::scaled:
                put_nearest(to, row, first.number(row) * t.factor);
                break;
            case way::channel:
                put_at(to, row, byte_of(first, row));
                break;
            case way::packed: {
                std::uint32_t bits = 0;
                for (std::size_t k = 0; k < t.from.size(); ++k)
                    bits |= std::uint32_t{byte_of(rows.columns[t.from[k]], row)}
                            << (k == 3 ? 24 : 16 - 8 * k);
                put_at(to, row, bits);
                break;
            }
            case way::unpacked: {
                std::uint32_t bits = 0;
                std::memcpy(&bits, first.values.data() + row * sizeof bits, sizeof bits);
                put_at(to, row, static_cast<std::uint8_t>(bits >> t.shift & 0xff));
                break;
            }
            case way::copied:
                break;
        }
    }
}

element translation::apply(const element& rows) const {
    element made{.name = rows.name, .rows = rows.rows};
    for (const target& t : targets_) {
        column c = t.declared;
        if (c.role == column_role::data) fill(c, t, rows);
        made.columns.push_back(std::move(c));
    }
    return made;
}

}  // namespace treeform::detail::attribute

namespace treeform {

std::vector<std::string> element::columns_called(std::string_view column_name) const {
    if (const column* const c = find(column_name); c && c->role == column_role::data)
        return {c->name};
    std::vector<std::string> names;
    if (const auto use = detail::attribute::use_called(column_name))
        for (const column& c : columns)
            if (c.role == column_role::data && detail::attribute::is_use(c.name, *use))
                names.push_back(c.name);
    return names;
}

}  // namespace treeform
