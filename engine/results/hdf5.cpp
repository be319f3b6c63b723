#include "results/hdf5.hpp"

#include <iostream>
#include <string_view>

#include "drillstrand/version.hpp"

namespace drillstrand::hdf5 {

namespace {

/// Variable-length UTF-8: no limit of length, and readers get text rather than bytes.
H5::StrType text_type() {
    H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
    type.setCset(H5T_CSET_UTF8);
    return type;
}

H5::Attribute attribute(H5::H5Object& object, const char* name, const H5::DataType& type) {
    if (object.attrExists(name)) return object.openAttribute(name);
    return object.createAttribute(name, type, H5::DataSpace(H5S_SCALAR));
}

/// Picks the operating system's words out of "..., error message = 'No space left on device', ...".
herr_t find_system_error(unsigned, const H5E_error2_t* error, void* found) {
    constexpr std::string_view marker = "error message = '";
    const std::string_view text = error->desc ? error->desc : "";
    const std::size_t start = text.find(marker);
    if (start != std::string_view::npos) {
        const std::size_t begin = start + marker.size();
        *static_cast<std::string*>(found) = text.substr(begin, text.find('\'', begin) - begin);
    }
    return 0;
}

}  // namespace

QuietErrors::QuietErrors() : error_stream_(std::cerr.rdstate()) {
    std::cerr.setstate(std::ios::failbit);
    H5::Exception::getAutoPrint(function_, &client_data_);
    H5::Exception::dontPrint();
}

QuietErrors::~QuietErrors() {
    H5Eset_auto2(H5E_DEFAULT, function_, client_data_);
    std::cerr.clear(error_stream_);
}

std::string reason(const H5::Exception& exception) {
    std::string found;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_system_error, &found);
    return found.empty() ? exception.getDetailMsg() : found;
}

H5::FileAccPropList file_access() {
    H5::FileAccPropList access;
    access.setFcloseDegree(H5F_CLOSE_STRONG);
    H5Pset_file_locking(access.getId(), false, true);
    access.setSieveBufSize(0);  // a write that fails does so where it is asked for, not at a close
    return access;
}

namespace {

std::vector<const char*> pointers_to(const std::vector<std::string>& texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts)
        pointers.push_back(text.c_str());
    return pointers;
}

}  // namespace

H5::DataSet create_dataset(H5::H5File& file, const std::string& path, bool integer,
                           const H5::DataSpace& space, const H5::DSetCreatPropList& properties,
                           const std::string& units, const std::string& description,
                           const H5::DSetAccPropList& access) {
    const H5::DataType type =
        integer ? H5::DataType(H5::PredType::STD_I64LE) : H5::DataType(H5::PredType::IEEE_F64LE);
    H5::DataSet dataset = file.createDataSet(path, type, space, properties, access);
    write_attribute(dataset, "units", units);
    write_attribute(dataset, "description", description);
    return dataset;
}

void write_values(H5::H5File& file, const std::string& path, bool integer,
                  const std::vector<hsize_t>& shape, const std::string& units,
                  const std::string& description, const std::vector<double>& values) {
    const H5::DataSpace space(static_cast<int>(shape.size()), shape.data());
    create_dataset(file, path, integer, space, H5::DSetCreatPropList::DEFAULT, units, description)
        .write(values.data(), H5::PredType::NATIVE_DOUBLE);
}

void write_texts(H5::H5File& file, const std::string& path, const std::string& description,
                 const std::vector<std::string>& texts) {
    const hsize_t count = texts.size();
    H5::DataSet dataset = file.createDataSet(path, text_type(), H5::DataSpace(1, &count));
    if (count > 0) dataset.write(pointers_to(texts).data(), text_type());
    write_attribute(dataset, "units", std::string("1"));
    write_attribute(dataset, "description", description);
}

void write_mesh(H5::H5File& file, const std::string& parent, const ResultHeader& header) {
    for (const auto& entry : mesh_datasets()) {
        std::vector<double> values;
        entry.append(header, values);
        write_values(file, parent + entry.path, entry.integer,
                     shape(entry, header.segment_s.size(), 0), entry.units, entry.description,
                     values);
    }
}

void write_origin(H5::Group& root, const ResultHeader& header) {
    write_attribute(root, "title", header.title);
    write_attribute(root, "case", header.case_text);
    write_attribute(root, "version", version());
    write_attribute(root, "commit", commit());
}

void write_attribute(H5::H5Object& object, const char* name, const std::string& value) {
    const char* text = value.c_str();
    attribute(object, name, text_type()).write(text_type(), &text);
}

void write_attribute(H5::H5Object& object, const char* name,
                     const std::vector<std::string>& texts) {
    if (object.attrExists(name)) object.removeAttr(name);
    const hsize_t count = texts.size();
    const H5::Attribute list = object.createAttribute(name, text_type(), H5::DataSpace(1, &count));
    if (count > 0) list.write(text_type(), pointers_to(texts).data());
}

void write_attribute(H5::H5Object& object, const char* name, double value) {
    attribute(object, name, H5::PredType::IEEE_F64LE).write(H5::PredType::NATIVE_DOUBLE, &value);
}

void write_attribute(H5::H5Object& object, const char* name, std::int64_t value) {
    attribute(object, name, H5::PredType::STD_I64LE).write(H5::PredType::NATIVE_INT64, &value);
}

}  // namespace drillstrand::hdf5
