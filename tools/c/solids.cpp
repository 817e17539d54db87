#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/repair.hpp>

#include <tools/c/inputs.hpp>
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

static tf::repair_scope scope_of(treeform_repair_scope scope) {
    return glue::choice<tf::repair_scope>(scope, 2, "scope");
}

treeform_code treeform_repair_file(const treeform_file* file, treeform_repair_scope scope,
                                   const treeform_repair_options* options,
                                   treeform_repair_result** result) {
    return glue::guard([&] {
        glue::start(result);
        auto made = glue::make<treeform_repair_result>();
        const glue::usable_input input(glue::need(file, "file").content);
        tf::repaired_file& kept =
            made->keep(tf::repair_file(input.source(), glue::read(options), scope_of(scope)));
        const treeform_code code = glue::code_of(kept.certificate);
        glue::fill(*made, kept, made->value);
        made->value.file = glue::keep(*made, std::move(kept.file));
        made->value.mesh = glue::arrays(made->value.file->content.mesh);
        glue::give(std::move(made), result);
        return code;
    });
}

treeform_code treeform_find_solid_defects_of_file(const treeform_file* file,
                                                  treeform_repair_scope scope,
                                                  treeform_progress progress, void* progress_data,
                                                  treeform_solid_defects** defects) {
    return glue::guard([&] {
        glue::start(defects);
        const glue::usable_input input(glue::need(file, "file").content);
        tf::solid_defects found = tf::find_solid_defects(input.source(), scope_of(scope),
                                                         glue::progress(progress, progress_data));
        found.unusable_faces += input.dropped();
        return glue::give(std::move(found), defects);
    });
}
