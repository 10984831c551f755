//! Campaigns with other frames than the simulator's.

use std::path::Path;
use vuris::frames::RawSets;
use vuris::recording::{Recording, write_recording};

/// A sample of a campaign, by numbers from 0. No test needs all of them.
#[derive(Clone, Copy)]
#[allow(dead_code)]
pub struct Sample {
    pub recording: usize,
    pub set: usize,
    /// Of its set.
    pub frame: usize,
    pub row: usize,
    pub column: usize,
    pub code: f64,
}

/// Rewrites every recording of the campaign, by its number, as `change` leaves it.
pub fn rewrite_recordings(campaign: &Path, change: impl Fn(usize, &mut Recording)) {
    let entries = std::fs::read_dir(campaign).unwrap().map(|entry| entry.unwrap().path());
    let mut folders: Vec<_> = entries.filter(|folder| folder.join("recording.toml").exists()).collect();
    folders.sort();
    for (number, folder) in folders.iter().enumerate() {
        let mut recording = Recording::open(folder).unwrap();
        change(number, &mut recording);
        std::fs::remove_dir_all(folder).unwrap();
        write_recording(&recording, folder).unwrap();
    }
}

/// Rewrites every code of the campaign's recordings by `change`.
#[allow(dead_code)]
pub fn rewrite(campaign: &Path, change: impl Fn(Sample) -> f64) {
    rewrite_recordings(campaign, |number, recording| {
        let geometry = recording.geometry();
        let frames = recording.raw.frames_per_set();
        let codes = recording.raw.codes().iter().enumerate().map(|(at, &code)| {
            let (index, (row, column)) =
                (at / geometry.pixels(), geometry.row_column(at % geometry.pixels()));
            let (set, frame, code) = (index / frames, index % frames, f64::from(code));
            let changed = change(Sample { recording: number, set, frame, row, column, code });
            changed.round().clamp(0.0, 4095.0) as u32
        });
        recording.raw = RawSets::new(geometry, frames, codes.collect()).unwrap();
    });
}

/// Takes out of the campaign's recordings the sets that are not `kept` (number of the recording, of the set).
#[allow(dead_code)]
pub fn thin_out(campaign: &Path, kept: impl Fn(usize, usize) -> bool) {
    rewrite_recordings(campaign, |number, recording| {
        assert!(recording.frame_times_s.is_none(), "times of frames would have to be taken out, too");
        let (geometry, frames) = (recording.geometry(), recording.raw.frames_per_set());
        let mut set = 0;
        recording.sets.retain(|_| {
            set += 1;
            kept(number, set - 1)
        });
        let sets = recording.raw.codes().chunks(frames * geometry.pixels()).enumerate();
        let codes = sets.filter(|(set, _)| kept(number, *set)).flat_map(|(_, codes)| codes).copied();
        recording.raw = RawSets::new(geometry, frames, codes.collect()).unwrap();
    });
}
