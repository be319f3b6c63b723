#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "drillstrand/result_file.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/output_datasets.hpp"
#include "results/reading.hpp"
#include "results/scene_datasets.hpp"

namespace drillstrand {

namespace {

/// A frame of a profile is a chunk of its own, written once, so it is compressed. A chunk of
/// samples is written again and again until it is full: compressed, it would grow and move each
/// time, and its old place be taken by other data before the file's tables know of the move, so
/// that a kill in that moment would lose the chunk. It stays as it is, in its place.
constexpr hsize_t samples_per_chunk = 512;
constexpr auto stale_after = std::chrono::seconds(1);
constexpr auto texts_stale_after = std::chrono::seconds(10);
/// What waits in memory between flushes, and is lost when the disk turns out to be full.
constexpr std::size_t most_pending_bytes = std::size_t{1} << 20;

namespace fs = std::filesystem;

/// The datasets of one kind of record: they grow together, the times last, so that every time in
/// the file has its data.
template <class Record>
class RecordTable {
  public:
    RecordTable(H5::H5File& file, std::vector<RecordDataset<Record>> layout, hsize_t segments)
        : layout_(std::move(layout)), segments_(segments), pending_(layout_.size()) {
        for (const auto& entry : layout_) {
            const bool is_frame = entry.rows != Rows::one;
            const auto chunk_shape = hdf5::shape(entry, segments, is_frame ? 1 : samples_per_chunk);
            auto initial = chunk_shape;
            auto most = chunk_shape;
            initial.front() = 0;
            most.front() = H5S_UNLIMITED;
            const int rank = static_cast<int>(chunk_shape.size());
            H5::DSetCreatPropList properties;
            properties.setChunk(rank, chunk_shape.data());
            if (is_frame) {
                properties.setShuffle();
                properties.setDeflate(hdf5::deflate_level);
            }
            const H5::DSetAccPropList access = without_cache();
            datasets_.push_back(hdf5::create_dataset(
                file, entry.path, entry.integer, H5::DataSpace(rank, initial.data(), most.data()),
                properties, entry.units, entry.description, access));
            make_index(datasets_.back(), chunk_shape, is_frame);
            add_chunk(chunk_shape);
        }
    }

    /// Opens the datasets of a file, of which the first `records` records are to be kept.
    RecordTable(H5::H5File& file, std::vector<RecordDataset<Record>> layout, hsize_t segments,
                hsize_t records)
        : layout_(std::move(layout)),
          segments_(segments),
          pending_(layout_.size()),
          written_(records) {
        for (const auto& entry : layout_) {
            const H5::DataSet& dataset =
                datasets_.emplace_back(file.openDataSet(entry.path, without_cache()));
            const auto expected = hdf5::shape(entry, segments, 1);
            const auto found = extent_of(dataset);
            if (found.size() != expected.size() ||
                !std::equal(found.begin() + 1, found.end(), expected.begin() + 1))
                throw ResultError(entry.path + " has another shape");
            if (found.front() < records)
                throw ResultError(
                    fmt::format("{} holds {} records, not {}", entry.path, found.front(), records));
            std::vector<hsize_t> chunk_shape(found.size());
            dataset.getCreatePlist().getChunk(static_cast<int>(chunk_shape.size()),
                                              chunk_shape.data());
            add_chunk(chunk_shape);
        }
    }

    void drop_times() { drop(0); }

    void drop_values() {
        for (std::size_t k = 1; k < datasets_.size(); ++k)
            drop(k);
    }

    /// Throws ResultError where a chunk of the records is missing: HDF5 would read zeros.
    void require_chunks() const {
        for (std::size_t k = 0; k < datasets_.size(); ++k) {
            hsize_t chunk[H5S_MAX_RANK] = {};
            datasets_[k].getCreatePlist().getChunk(H5S_MAX_RANK, chunk);
            const hsize_t expected = (written_ + chunk[0] - 1) / chunk[0];
            hsize_t found = 0;
            const H5::DataSpace space = datasets_[k].getSpace();
            if (written_ > 0 && H5Dget_num_chunks(datasets_[k].getId(), space.getId(), &found) < 0)
                throw ResultError(layout_[k].path + ": its chunks cannot be counted");
            if (found != expected)
                throw ResultError(fmt::format("{} is damaged: {} of {} chunks are missing",
                                              layout_[k].path, expected - found, expected));
        }
    }

    void read_last_time() {
        if (written_ == 0) return;
        const hsize_t one = 1;
        const hsize_t last = written_ - 1;
        const H5::DataSpace memory(1, &one);
        H5::DataSpace source = datasets_[0].getSpace();
        source.selectHyperslab(H5S_SELECT_SET, &one, &last);
        datasets_[0].read(&last_time_, H5::PredType::NATIVE_DOUBLE, memory, source);
    }

    void append(const Record& record) {
        for (std::size_t k = 0; k < layout_.size(); ++k)
            layout_[k].append(record, pending_[k]);
        ++pending_records_;
    }

    [[nodiscard]] std::size_t pending_bytes() const {
        std::size_t count = 0;
        for (const auto& values : pending_)
            count += values.size();
        return count * sizeof(double);
    }

    /// Most bytes that writing the pending records takes: a chunk that is written again moves to
    /// new space.
    [[nodiscard]] std::size_t needed_bytes() const { return chunk_bytes_ + pending_bytes(); }

    void write_values() {
        for (std::size_t k = 1; k < datasets_.size(); ++k)
            write(k);
    }

    void write_times() {
        write(0);
        if (pending_records_ > 0) last_time_ = pending_.front()[pending_records_ - 1];
        written_ += pending_records_;
        for (auto& values : pending_)
            values.clear();
        pending_records_ = 0;
    }

    /// Time of the last record in the file; 0 before the first one (s).
    [[nodiscard]] double last_time() const { return last_time_; }
    [[nodiscard]] hsize_t written() const { return written_; }

    void close() {
        for (H5::DataSet& dataset : datasets_)
            dataset.close();
    }

  private:
    /// Chunks go out as they are written, so that their places are known before a flush.
    static H5::DSetAccPropList without_cache() {
        H5::DSetAccPropList access;
        access.setChunkCache(0, 0, 1);
        return access;
    }

    static std::vector<hsize_t> extent_of(const H5::DataSet& dataset) {
        const H5::DataSpace space = dataset.getSpace();
        std::vector<hsize_t> extent(static_cast<std::size_t>(space.getSimpleExtentNdims()));
        space.getSimpleExtentDims(extent.data());
        return extent;
    }

    /// A dataset gets the table of its chunks with the first of them. It must be there before the
    /// file takes its name: a kill between the writing of the one that names the table and of the
    /// table itself would lose the dataset. So a chunk is made and dropped again.
    static void make_index(H5::DataSet& dataset, std::vector<hsize_t> extent, bool is_frame) {
        const std::vector<hsize_t> start(extent.size(), 0);
        extent.front() = 1;
        dataset.extend(extent.data());
        if (is_frame) {
            const double anything = 0;
            if (H5Dwrite_chunk(dataset.getId(), H5P_DEFAULT, 0, start.data(), sizeof anything,
                               &anything) < 0)
                throw H5::DataSetIException("H5Dwrite_chunk", "no chunk can be written");
        } else {
            const H5::DataSpace memory(static_cast<int>(extent.size()), extent.data());
            const std::vector<double> zeros(
                static_cast<std::size_t>(memory.getSimpleExtentNpoints()), 0.0);
            dataset.write(zeros.data(), H5::PredType::NATIVE_DOUBLE, memory);
        }
        extent.front() = 0;
        if (H5Dset_extent(dataset.getId(), extent.data()) < 0)
            throw H5::DataSetIException("H5Dset_extent", "a chunk cannot be dropped");
    }

    void add_chunk(const std::vector<hsize_t>& chunk_shape) {
        std::size_t chunk_values = 1;
        for (const hsize_t extent : chunk_shape)
            chunk_values *= extent;
        chunk_bytes_ += chunk_values * sizeof(double);
    }

    void drop(std::size_t k) {
        auto extent = extent_of(datasets_[k]);
        if (extent.front() == written_) return;
        extent.front() = written_;
        if (H5Dset_extent(datasets_[k].getId(), extent.data()) < 0)
            throw ResultError(layout_[k].path + " cannot be cut to its first records");
    }

    void write(std::size_t k) {
        if (pending_records_ == 0) return;
        auto extent = hdf5::shape(layout_[k], segments_, pending_records_);
        const int rank = static_cast<int>(extent.size());
        const H5::DataSpace memory(rank, extent.data());
        std::vector<hsize_t> start(extent.size(), 0);
        start.front() = written_;
        auto grown = extent;
        grown.front() += written_;
        datasets_[k].extend(grown.data());
        H5::DataSpace target = datasets_[k].getSpace();
        target.selectHyperslab(H5S_SELECT_SET, extent.data(), start.data());
        datasets_[k].write(pending_[k].data(), H5::PredType::NATIVE_DOUBLE, memory, target);
    }

    std::vector<RecordDataset<Record>> layout_;
    hsize_t segments_;
    std::vector<H5::DataSet> datasets_;
    std::vector<std::vector<double>> pending_;  ///< per dataset: values not yet in the file
    hsize_t pending_records_ = 0;
    hsize_t written_ = 0;
    double last_time_ = 0;
    std::size_t chunk_bytes_ = 0;
};

H5::H5File create_file(const fs::path& path, const ResultHeader& header) {
    H5::H5File file(path, H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    for (const char* group : {"/mesh", "/series", "/profiles"})
        file.createGroup(group);
    H5::Group root = file.openGroup("/");
    hdf5::write_origin(root, header);
    hdf5::write_attribute(root, "integrator", header.integrator);
    hdf5::write_attribute(root, "threads", std::int64_t{header.threads});
    hdf5::write_attribute(root, "isa", header.isa);
    hdf5::write_mesh(file, "", header);
    hdf5::write_scene(file, header);
    hdf5::write_sensors(file, header);
    hdf5::write_cycles(file, header);
    return file;
}

H5::H5File open_file(const fs::path& path) {
    H5::H5File file(path, H5F_ACC_RDWR, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    // A kill inside a flush leaves the end as it was before, in front of data that the file's
    // tables may know already: new data must not go there.
    if (H5Fincrement_filesize(file.getId(), 0) < 0) throw ResultError("its end is not found");
    return file;
}

/// Throws ResultError where another string or integrator made the file.
void require_same_run(const fs::path& path, const ResultHeader& header) {
    hdf5::read_file(path, [&](hdf5::UntrustedFile& file) {
        ResultHeader found;
        hdf5::read_mesh(file, "", found);
        hdf5::read_attribute(file.hdf5().openGroup("/"), "integrator", found.integrator);
        if (found.node_s != header.node_s || found.segment_s != header.segment_s)
            throw ResultError("it holds the results of another string");
        if (found.integrator != header.integrator)
            throw ResultError(
                fmt::format("it was made by {}, not by {}", found.integrator, header.integrator));
    });
}

/// Everything in HDF5 that is open while a result file is written.
struct OpenFile {
    H5::H5File file;
    H5::Group root;
    RecordTable<SeriesRecord> series;
    RecordTable<Profile> profiles;
    std::vector<RecordTable<SensorRecord>> sensors;
    std::chrono::steady_clock::time_point texts_written;  ///< when they last were
    bool closing = false;

    OpenFile(const fs::path& path, const ResultHeader& header)
        : file(create_file(path, header)),
          root(file.openGroup("/")),
          series(file, series_datasets(), header.segment_s.size()),
          profiles(file, profile_datasets(), header.segment_s.size()) {
        for (const SensorCase& sensor : header.sensors)
            sensors.emplace_back(file, sensor_datasets(sensor.name), header.segment_s.size());
    }

    OpenFile(const fs::path& path, const ResultHeader& header, hsize_t series_records,
             hsize_t profile_records, const std::vector<std::size_t>& sensor_records)
        : file((require_same_run(path, header), open_file(path))),
          root(file.openGroup("/")),
          series(file, series_datasets(), header.segment_s.size(), series_records),
          profiles(file, profile_datasets(), header.segment_s.size(), profile_records) {
        for (std::size_t i = 0; i < header.sensors.size(); ++i)
            sensors.emplace_back(file, sensor_datasets(header.sensors[i].name),
                                 header.segment_s.size(), sensor_records.at(i));
    }

    /// Calls action(table) for each table of records.
    template <class Action>
    void for_each_table(const Action& action) {
        action(series);
        action(profiles);
        for (RecordTable<SensorRecord>& sensor : sensors)
            action(sensor);
    }

    /// Back to the records that are to be kept; times first, so that none is without its values.
    void drop_others(const HeldFile& held) {
        drop_times();
        flush(held);
        for_each_table([](auto& table) { table.drop_values(); });
        for_each_table([](auto& table) { table.require_chunks(); });
        for_each_table([](auto& table) { table.read_last_time(); });
    }

    void drop_times() {
        for_each_table([](auto& table) { table.drop_times(); });
    }

    void write_values() {
        for_each_table([](auto& table) { table.write_values(); });
    }

    void write_times() {
        for_each_table([](auto& table) { table.write_times(); });
    }

    /// Most bytes that writing the pending records takes.
    [[nodiscard]] std::size_t needed_bytes() {
        std::size_t bytes = 0;
        for_each_table([&](const auto& table) { bytes += table.needed_bytes(); });
        return bytes;
    }

    void write_status(const ResultFooter& footer) {
        hdf5::write_attribute(root, "status", footer.status);
    }

    void write_numbers(const ResultFooter& footer) {
        hdf5::write_attribute(root, "wall_seconds", footer.wall_seconds);
        hdf5::write_attribute(root, "steps", footer.statistics.steps);
        hdf5::write_attribute(root, "steps_rejected", footer.statistics.rejected);
        hdf5::write_attribute(root, "evaluations", footer.statistics.evaluations);
        hdf5::write_attribute(root, "smallest_step", footer.statistics.smallest_step);
        hdf5::write_attribute(root, "largest_step", footer.statistics.largest_step);
        hdf5::write_attribute(root, "time_error", footer.statistics.time_error);
        hdf5::write_attribute(root, "energy_residual", footer.energy_residual);
        hdf5::write_attribute(root, "largest_penetration", footer.largest_penetration);
        hdf5::write_attribute(root, "time_error_median", footer.time_error_median);
        hdf5::write_attribute(root, "stick_slip_index", footer.stick_slip_index);
        hdf5::write_attribute(root, "stuck_share", footer.stuck_share);
        hdf5::write_attribute(root, "unloaded_share", footer.unloaded_share);
    }

    void write_texts(const ResultFooter& footer) {
        hdf5::write_attribute(root, "warnings", footer.warnings);
        hdf5::write_attribute(root, "findings", footer.findings);
        hdf5::rewrite_cycles(file, footer.cycles);
    }

    /// Not at every flush: texts take new space each time.
    void write_stale_texts(const ResultFooter& footer) {
        const auto now = std::chrono::steady_clock::now();
        if (now - texts_written < texts_stale_after) return;
        write_texts(footer);
        texts_written = now;
    }

    /// The file's end goes first: tables that are cut off by a kill may name places up to it.
    void flush(const HeldFile& held) {
        haddr_t end = 0;
        if (H5Fget_eoa(file.getId(), &end) < 0)
            throw H5::FileIException("H5Fget_eoa", "the end of the file is not known");
        held.write_hdf5_end(end);
        file.flush(H5F_SCOPE_GLOBAL);
    }

    void close() {
        closing = true;
        for_each_table([](auto& table) { table.close(); });
        root.close();
        file.close();
    }
};

}  // namespace

struct ResultWriter::Impl {
    using Clock = std::chrono::steady_clock;

    /// The file is made beside its place and takes its name once it is sound, so that a start that
    /// fails leaves an older result as it was.
    Impl(const fs::path& path, const ResultHeader& header, Existing existing)
        : shown_path_(path), file_path_(followed(path)) {
        NewFile fresh(path, existing);
        fresh.held().require_space(metadata_bytes);
        try {
            attempt([&] {
                open_ = std::make_unique<OpenFile>(fresh.path(), header);
                open_->write_status({});
                open_->write_numbers({});
                open_->write_texts({});
                open_->flush(fresh.held());
            });
            fresh.take_name();
            held_ = fresh.release();
            held_->remember_size();
        } catch (...) {
            close_quietly();
            throw;
        }
    }

    Impl(const fs::path& path, const ResultHeader& header, hsize_t series_records,
         hsize_t profile_records, const std::vector<std::size_t>& sensor_records)
        : shown_path_(path),
          file_path_(followed(path)),
          held_(std::make_unique<HeldFile>(HeldFile::open(file_path_, path))) {
        held_->require_space(metadata_bytes);
        try {
            hdf5::attempt(shown_path_, "go on with it", [&] {
                open_ = std::make_unique<OpenFile>(file_path_, header, series_records,
                                                   profile_records, sensor_records);
            });
            attempt([&] {
                open_->drop_others(*held_);
                open_->write_status({});
                open_->flush(*held_);
            });
        } catch (const WriteError&) {
            close_quietly();
            throw;
        } catch (const ResultError& error) {
            close_quietly();
            const std::string why = error.what();
            if (why.starts_with(shown_path_.string())) throw;
            throw ResultError(shown_path_.string() + ": cannot go on with it: " + why);
        } catch (...) {
            close_quietly();
            throw;
        }
        written_until_ = open_->series.last_time();
        held_->remember_size();
    }

    ~Impl() {
        if (!open_) return;
        try {
            if (!failed_) write_pending();
        } catch (const std::exception&) {
            // What reached the file before stays readable; nobody is left to tell.
        }
        close_quietly();
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    template <class Record>
    void append(RecordTable<Record>& table, const Record& record) {
        table.append(record);
        if (table.pending_bytes() > most_pending_bytes) write_pending();
    }

    void flush(const ResultFooter& footer) {
        write_pending();
        attempt([&] {
            open_->write_numbers(footer);
            open_->write_stale_texts(footer);
            open_->flush(*held_);
        });
        held_->remember_size();
    }

    void sync() { held_->sync(); }

    void close(ResultFooter footer) {
        if (!held_) return;  // it failed before
        std::string lost;
        if (!failed_) {
            try {
                write_pending();
            } catch (const ResultError& error) {
                lost = error.what();
                footer.status = "failed: " + lost;
            }
        }
        try {
            require_held();
            attempt([&] {
                if (failed_) open_->drop_times();
                open_->write_numbers(footer);
                open_->write_texts(footer);
                open_->write_status(footer);
                open_->flush(*held_);
                written_records_ = {open_->series.written(), open_->profiles.written()};
                open_->close();
            });
            open_.reset();
            require_whole();
        } catch (const ResultError& error) {
            close_quietly();
            if (lost.empty()) lost = error.what();
        }
        held_.reset();
        if (!lost.empty()) throw WriteError(lost);
    }

    [[nodiscard]] bool is_stale() const { return Clock::now() - last_flush_ > stale_after; }
    [[nodiscard]] double written_until() const { return written_until_; }
    [[nodiscard]] bool is_lost() const { return lost_; }
    [[nodiscard]] OpenFile& open() { return *open_; }

  private:
    template <class Action>
    void attempt(Action&& action) {
        hdf5::attempt<WriteError>(shown_path_, "write", action);
    }

    void require_held() {
        lost_ = true;
        held_->require_name(file_path_);
        held_->require_size();
        lost_ = false;
    }

    /// What others did to the file since the last look shows only in the file itself.
    void require_whole() {
        lost_ = true;
        held_->require_name(file_path_);
        hdf5::attempt<WriteError>(shown_path_, "read what was written", [&] {
            const H5::H5File file(file_path_, H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT,
                                  hdf5::file_access());
            const auto count = [&](const std::string& path) {
                return static_cast<hsize_t>(
                    file.openDataSet(path).getSpace().getSimpleExtentNpoints());
            };
            if (count(series_datasets().front().path) != written_records_.first ||
                count(profile_datasets().front().path) != written_records_.second)
                throw WriteError(shown_path_.string() +
                                 ": changed by another program while results were written to it");
        });
        lost_ = false;
    }

    /// Values first and times last, each on disk before the next: a file that is cut off between
    /// them has data for every time.
    void write_pending() {
        last_flush_ = Clock::now();
        failed_ = true;
        require_held();
        held_->require_space(open_->needed_bytes() + metadata_bytes);
        attempt([&] {
            open_->write_values();
            open_->flush(*held_);
            open_->write_times();
            open_->flush(*held_);
        });
        held_->remember_size();
        written_until_ = open_->series.last_time();
        failed_ = false;
    }

    /// HDF5 objects that cannot be closed are left to the end of the process: their destructors
    /// would try again and print, and HDF5 does not survive a second try.
    void close_quietly() {
        if (!open_) return;
        if (open_->closing) {
            static_cast<void>(open_.release());
            return;
        }
        try {
            attempt([&] { open_->close(); });
            open_.reset();
        } catch (const std::exception&) {
            static_cast<void>(open_.release());
        }
    }

    fs::path shown_path_;  ///< as the caller wrote it
    fs::path file_path_;
    std::unique_ptr<HeldFile> held_;
    std::unique_ptr<OpenFile> open_;
    bool failed_ = false;  ///< records were lost: the pending ones no longer follow the file's
    bool lost_ = false;    ///< the file is not there any more, or not as it was written
    std::pair<hsize_t, hsize_t> written_records_;  ///< series and profiles
    double written_until_ = 0;
    Clock::time_point last_flush_ = Clock::now();
};

ResultWriter::ResultWriter(const std::filesystem::path& path, const ResultHeader& header,
                           Existing existing)
    : impl_(std::make_unique<Impl>(path, header, existing)) {}
ResultWriter::ResultWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ResultWriter::~ResultWriter() = default;
ResultWriter::ResultWriter(ResultWriter&&) noexcept = default;
ResultWriter& ResultWriter::operator=(ResultWriter&&) noexcept = default;

ResultWriter ResultWriter::resume(const std::filesystem::path& path, const ResultHeader& header,
                                  std::size_t series_records, std::size_t profile_records,
                                  const std::vector<std::size_t>& sensor_records) {
    return ResultWriter(
        std::make_unique<Impl>(path, header, series_records, profile_records, sensor_records));
}

void ResultWriter::append(const SeriesRecord& record) {
    impl_->append(impl_->open().series, record);
}

void ResultWriter::append(const Profile& profile) {
    impl_->append(impl_->open().profiles, profile);
}

void ResultWriter::append(std::size_t sensor, const SensorRecord& record) {
    impl_->append(impl_->open().sensors.at(sensor), record);
}

bool ResultWriter::is_stale() const {
    return impl_->is_stale();
}

double ResultWriter::written_until() const {
    return impl_->written_until();
}

bool ResultWriter::is_lost() const {
    return impl_->is_lost();
}

void ResultWriter::sync() {
    impl_->sync();
}

void ResultWriter::flush(const ResultFooter& footer) {
    impl_->flush(footer);
}

void ResultWriter::close(const ResultFooter& footer) {
    impl_->close(footer);
}

}  // namespace drillstrand
