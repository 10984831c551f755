//! What a processor does to the registers: at rest, while sets are taken, and across resets.

use super::scenario::random_sets;
use crate::hdl::Segment;
use crate::model::{Access, StreamEvent, beats_of_set};
use crate::spec::{ADDRESS_BITS, Pipeline, REGISTER_BYTES, REGISTERS};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn read(address: u32) -> StreamEvent {
    StreamEvent::Access(Access::Read { address })
}

fn write(address: u32, data: u32, strobes: u32) -> StreamEvent {
    StreamEvent::Access(Access::Write { address, data, strobes })
}

/// Byte addresses of all registers.
fn addresses() -> impl Iterator<Item = u32> {
    (0..).step_by(REGISTER_BYTES as usize).take(REGISTERS.len())
}

/// Reads of every register.
pub fn read_all() -> Vec<StreamEvent> {
    addresses().map(read).collect()
}

/// Everything once: reads of every register and of what lies beyond, at every byte; writes to what is only read and to what does not
/// exist, and of every combination of bytes to what can be written, each read back.
fn everything_once() -> Vec<StreamEvent> {
    let end = REGISTER_BYTES * REGISTERS.len() as u32;
    let last = (1 << ADDRESS_BITS) - 1;
    let mut events = read_all();
    events.extend([1, 2, 3, end, end + 1, last].map(read));
    // Every bit of an address counts: beyond the map nothing is there again.
    let beyond = || (0..ADDRESS_BITS).map(|bit| 1 << bit).filter(move |&bit| bit >= end);
    let again: Vec<u32> = beyond().flat_map(|bit| addresses().map(move |address| address | bit)).collect();
    events.extend(again.iter().copied().map(read));
    let writes = addresses().chain([end, last]).chain(again);
    events.extend(writes.map(|address| write(address, 0xdead_beef, 15)));
    events.extend(read_all());
    for (address, _) in addresses().zip(REGISTERS).filter(|(_, register)| register.writable()) {
        for strobes in 0..16 {
            events.push(write(address, 0x0101_0101_u32.wrapping_mul(17 * strobes + 3), strobes));
            events.push(read(address));
        }
        // One after the other, so that answers and the next writes meet.
        events.extend((0..6).map(|byte| write(address + byte % 4, 0x1234_5678 << byte, 15)));
        events.push(read(address + 3));
    }
    events
}

/// A read of any register, more often than not, or a write.
fn any_access(random: &mut ChaCha8Rng) -> StreamEvent {
    let words = REGISTERS.len() as u32 + 2;
    let address = random.random_range(0..words * REGISTER_BYTES);
    match random.random_range(0..4) {
        0 => {
            let writable = REGISTERS.iter().position(|register| register.writable()).unwrap_or(0) as u32;
            write(writable * REGISTER_BYTES, random.next_u32(), random.random_range(0..16))
        }
        1 => write(address, random.next_u32(), random.random_range(0..16)),
        _ => read(address),
    }
}

/// Accesses at rest, while sets are taken and drain, and just before a reset, each kind with all counters read in the end; nothing
/// for a core without registers.
pub fn register_accesses(pipeline: &Pipeline, seed: u64) -> Vec<Segment> {
    if !pipeline.registers.axi4_lite {
        return Vec::new();
    }
    let segment = |name: &str, events| Segment { name: name.to_owned(), events };
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut at_rest = vec![StreamEvent::Rest];
    at_rest.extend(everything_once());
    at_rest.push(StreamEvent::Rest);
    let raw = random_sets(pipeline, seed, 2);
    let beats = |set| beats_of_set(&raw, set).map(StreamEvent::Beat);
    // Not so many that the stream is done before they are.
    let every = (beats(0).count() / 60).max(4);
    let mut beside = Vec::new();
    for (number, beat) in beats(0).chain(beats(1)).enumerate() {
        beside.push(beat);
        if number % every == every - 1 {
            beside.push(any_access(&mut random));
        }
    }
    beside.extend(read_all());
    let interrupted: Vec<StreamEvent> = beats(0).take(3).chain(at_rest[1..].iter().copied()).collect();
    let interrupted = interrupted[..interrupted.len() - 1].iter().copied();
    let reset: Vec<StreamEvent> =
        interrupted.chain([StreamEvent::Reset]).chain(read_all()).chain([StreamEvent::Rest]).collect();
    vec![
        segment("registers at rest", at_rest),
        segment("registers while sets are taken", beside),
        segment("reset while registers are accessed", reset),
        Segment::of_sets("good set after accesses", &random_sets(pipeline, seed + 1, 1)),
        segment("registers in the end", [vec![StreamEvent::Rest], read_all()].concat()),
    ]
}
