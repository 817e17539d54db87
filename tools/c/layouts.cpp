#include <treeform/mesh/align.hpp>
#include <treeform/mesh/pack.hpp>

#include <tools/c/made/structs.hpp>

namespace tf = treeform;

treeform_code treeform_lay_flat(const treeform_mesh* mesh, const treeform_lay_flat_options* options,
                                treeform_laid_flat** laid) {
    return glue::guard([&] {
        glue::start(laid);
        auto found = tf::lay_flat(glue::ref(mesh, "mesh"), glue::read(options));
        if (!found) return;
        glue::check(found->certificate.status);
        auto made = glue::make<treeform_laid_flat>();
        glue::fill(*made, made->keep(std::move(*found)), made->value);
        glue::give(std::move(made), laid);
    });
}

treeform_code treeform_pack(const treeform_mesh* const* parts, size_t count,
                            const treeform_pack_options* options, treeform_packing** packing) {
    return glue::guard([&] {
        glue::start(packing);
        auto made = glue::make<treeform_packing>();
        const auto& found =
            made->keep(tf::pack(glue::refs(parts, count, "parts"), glue::read(options)));
        glue::check(found.certificate.status);
        glue::fill(*made, found, made->value);
        const bool all_placed = found.not_placed.empty();
        if (!all_placed) glue::say(made->value.message);
        glue::give(std::move(made), packing);
        return all_placed ? TREEFORM_OK : TREEFORM_NO_PLACE;
    });
}

treeform_code treeform_align(const treeform_mesh* moving, const treeform_mesh* fixed,
                             const treeform_align_options* options,
                             treeform_align_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_align_result>();
        const auto& found =
            made->keep(tf::align(*glue::need(moving, "moving").prepared,
                                 *glue::need(fixed, "fixed").prepared, glue::read(options)));
        glue::check(found.status);
        glue::fill(*made, found, made->value);
        const bool converged = found.converged;
        if (!converged)
            glue::say((std::string(tf::name_of(found.end)) + ": " + found.message()).c_str());
        glue::give(std::move(made), result);
        return converged ? TREEFORM_OK : TREEFORM_NO_PLACE;
    });
}
