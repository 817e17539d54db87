#pragma once
/// \file
/// Made by tools/bindings of the headers of C++.

#include "../base.hpp"

namespace binding {

template <class Visit>
void each_field(tf::io_warning& how, const Visit& visit) {
    visit("code", how.code);
    visit("text", how.text);
}

template <class Visit>
void each_field(tf::column& how, const Visit& visit) {
    visit("name", how.name);
    visit("type", how.type);
    visit("list_length", how.list_length);
    visit("role", how.role);
    visit("values", how.values);
    visit("list_begin", how.list_begin);
}

template <class Visit>
void each_field(tf::element& how, const Visit& visit) {
    visit("name", how.name);
    visit("rows", how.rows);
    visit("columns", how.columns);
}

template <class Visit>
void each_field(tf::part& how, const Visit& visit) {
    visit("object", how.object);
    visit("group", how.group);
    visit("material", how.material);
    visit("first_face", how.first_face);
}

template <class Visit>
void each_field(tf::corner_values& how, const Visit& visit) {
    visit("texture", how.texture);
    visit("has_w", how.has_w);
    visit("normals", how.normals);
    visit("texture_of_corner", how.texture_of_corner);
    visit("normal_of_corner", how.normal_of_corner);
}

template <class Visit>
void each_field(tf::attributes& how, const Visit& visit) {
    visit("elements", how.elements);
    visit("corners", how.corners);
    visit("parts", how.parts);
    visit("material_files", how.material_files);
    visit("texture_files", how.texture_files);
    visit("comments", how.comments);
    visit("obj_info", how.obj_info);
    visit("header", how.header);
}

template <class Visit>
void each_field(tf::las_record& how, const Visit& visit) {
    visit("user_id", how.user_id);
    visit("record_id", how.record_id);
    visit("description", how.description);
    visit("reserved", how.reserved);
    visit("data", how.data);
}

template <class Visit>
void each_field(tf::las_header& how, const Visit& visit) {
    visit("version_minor", how.version_minor);
    visit("point_format", how.point_format);
    visit("scale", how.scale);
    visit("offset", how.offset);
    visit("block", how.block);
    visit("records", how.records);
    visit("behind_records", how.behind_records);
    visit("extended_records", how.extended_records);
}

template <class Visit>
void each_field(tf::value_range& how, const Visit& visit) {
    visit("column", how.column);
    visit("least", how.least);
    visit("greatest", how.greatest);
    visit("whole", how.whole);
}

template <class Visit>
void each_field(tf::mesh_file& how, const Visit& visit) {
    visit("stored_face", how.stored_face);
    visit("stored_faces", how.stored_faces);
    visit("indexed", how.indexed);
    visit("stored_as", how.stored_as);
    visit("format", how.format);
    visit("warnings", how.warnings);
    visit("attributes", how.attributes);
    visit("las", how.las);
    visit("ranges", how.ranges);
}

}  // namespace binding
