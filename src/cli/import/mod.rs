//! `vuris import`

mod camera;
mod taking;

use super::print::{counted, say};
use crate::frames::Geometry;
use crate::import::{
    ByteOrder, Channel, Number, RawLayout, Stack, Taking, each_file_once, natural_order, read_pictures,
    read_raw, recordings,
};
use crate::problem::{Problem, Result};
use crate::recording::{Kind, write_campaign, write_recording, write_recording_with_camera};
use clap::{Args, Subcommand, ValueEnum};
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::process::ExitCode;
use taking::Frames;

/// Make recordings of other instruments' phase-stepped frames: pictures, arrays, flat dumps
#[derive(Debug, Args)]
pub(super) struct Import {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Stack(Box<Pictures>),
    Raw(Box<Dumps>),
}

const STACK_EXAMPLE: &str = "A campaign (--recordings) is of one scene at one modulation frequency, whose pixels keep their phases: fringes of
several periods are imported each by itself.

Example: 24 pictures of 12 steps, two sets of a scene that stands still
  vuris import stack scene/*.bmp --steps 12 --step-deg 30 \\
    --frequency-hz 30e6 --frame-period-s 0.025 --out scene-01";

/// Pictures (BMP, PNG, TIFF of one page or many) or arrays (.npy, [frame, row, column]): frames in the natural order of the
/// files' names, N of them a set
#[derive(Debug, Args)]
#[command(after_help = STACK_EXAMPLE)]
struct Pictures {
    #[command(flatten)]
    frames: Frames,
    /// The colour that is the code, of pictures in colour
    #[arg(long, value_enum)]
    channel: Option<ChannelArgument>,
}

const RAW_EXAMPLE: &str =
    "Example: two sets of four frames, 240 rows of 320 columns, behind a header of 512 bytes
  vuris import raw run.bin --shape 8,240,320 --type u16 --byte-order big --offset 512 \\
    --steps 4 --step-deg 90 --frequency-hz 30e6 --frame-period-s 0.025 --out run";

/// Flat dumps of numbers, frame by frame, row by row
#[derive(Debug, Args)]
#[command(after_help = RAW_EXAMPLE)]
struct Dumps {
    #[command(flatten)]
    frames: Frames,
    /// Frames, rows and columns of each file
    #[arg(long, value_name = "F,R,C", value_parser = shape)]
    shape: Shape,
    /// Type of the numbers
    #[arg(long = "type", value_enum)]
    number: NumberArgument,
    /// Which byte of a number comes first: the least significant, or the most
    #[arg(long, value_enum)]
    byte_order: ByteOrderArgument,
    /// Bytes before the first number, which are skipped
    #[arg(long, value_name = "BYTES", default_value_t = 0)]
    offset: u64,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ChannelArgument {
    Red,
    Green,
    Blue,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum NumberArgument {
    U8,
    U16,
    I16,
    U32,
    F32,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ByteOrderArgument {
    Little,
    Big,
}

/// Frames, rows, columns.
#[derive(Debug, Clone, Copy)]
struct Shape {
    frames: usize,
    geometry: Geometry,
}

fn shape(text: &str) -> std::result::Result<Shape, String> {
    let sizes: Option<Vec<usize>> = text.split(',').map(|size| size.trim().parse().ok()).collect();
    match sizes.as_deref() {
        Some(&[frames @ 1..=0xffff_ffff, height @ 1..=65_536, width @ 1..=65_536]) => {
            Ok(Shape { frames, geometry: Geometry { width, height } })
        }
        _ => Err("expected frames,rows,columns, each at least 1, such as 12,480,640".to_owned()),
    }
}

impl Import {
    pub(super) fn run(self) -> Result<ExitCode> {
        match self.command {
            Command::Stack(pictures) => {
                let channel = pictures.channel.map(|channel| match channel {
                    ChannelArgument::Red => Channel::Red,
                    ChannelArgument::Green => Channel::Green,
                    ChannelArgument::Blue => Channel::Blue,
                });
                import(&pictures.frames, |files, stack| read_pictures(files, channel, stack))
            }
            Command::Raw(dumps) => {
                let layout = dumps.layout();
                import(&dumps.frames, |files, stack| read_raw(files, &layout, stack))
            }
        }
    }
}

impl Dumps {
    fn layout(&self) -> RawLayout {
        RawLayout {
            frames: self.shape.frames,
            geometry: self.shape.geometry,
            number: match self.number {
                NumberArgument::U8 => Number::U8,
                NumberArgument::U16 => Number::U16,
                NumberArgument::I16 => Number::I16,
                NumberArgument::U32 => Number::U32,
                NumberArgument::F32 => Number::F32,
            },
            byte_order: match self.byte_order {
                ByteOrderArgument::Little => ByteOrder::Little,
                ByteOrderArgument::Big => ByteOrder::Big,
            },
            offset: self.offset,
        }
    }
}

/// Everything that can be refused without the frames is, before they are read.
fn import(frames: &Frames, read: impl FnOnce(&[PathBuf], &mut Stack) -> Result<()>) -> Result<ExitCode> {
    let out = &frames.out;
    if out.symlink_metadata().is_ok() {
        return Err(Problem::in_file(out, "is there already")
            .expected("a new folder")
            .remedy("choose another --out, or move this one away"));
    }
    let known = frames.camera.read()?;
    let taking = frames.taking()?;
    each_file_once(&frames.files)?;
    let files = match frames.as_given {
        true => frames.files.clone(),
        false => natural_order(frames.files.clone()),
    };
    let mut stack = Stack::new(frames.levels(&known)?);
    read(&files, &mut stack)?;
    let camera = match stack.geometry() {
        Some(geometry) => known.camera(geometry),
        None => None,
    };
    let recordings = recordings(&stack, &taking, camera.as_ref(), out)?;
    match (&recordings[..], &camera) {
        ([recording], None) if taking.names.is_empty() => write_recording(recording, out)?,
        ([recording], Some(camera)) if taking.names.is_empty() => {
            write_recording_with_camera(recording, camera, out)?;
        }
        _ => write_campaign(&recordings, camera.as_ref(), out)?,
    }
    say_frames(&stack)?;
    for recording in &recordings {
        let set = counted(recording.raw.sets(), "set");
        let codes = recording.raw.codes();
        let (least, most) = (codes.iter().min().unwrap_or(&0), codes.iter().max().unwrap_or(&0));
        let at_most = codes.iter().filter(|&code| code == most).count();
        let folder = recording.folder.display();
        say!(
            "{folder}: {set} of {}, codes {least} to {most} ({at_most} of {} are {most})",
            counted(recording.steps_rad.len(), "frame"),
            codes.len(),
        );
    }
    let span_deg = span_rad(&taking).to_degrees();
    if span_deg < LEAST_SPAN_DEG && taking.kind != Kind::Dark {
        say!("all phase steps and offsets are within {span_deg:.1} degrees: is --step-deg in degrees?");
    }
    let mut unknown = Vec::new();
    if camera.is_none() {
        unknown.push("camera.toml (--camera; or --adc-bits, --pedestal-dn and what these ask for)");
    }
    if taking.positions_m.is_empty() {
        unknown.push("position_m of sets.csv (--position-m)");
    }
    if !unknown.is_empty() {
        say!("not known, and left out: {}", unknown.join(", "));
    }
    Ok(ExitCode::SUCCESS)
}

/// Phases that are as near are a slip of the unit, as a rule.
const LEAST_SPAN_DEG: f64 = 45.0;

/// From the least to the greatest phase of the frames, rad; a turn at most.
fn span_rad(taking: &Taking) -> f64 {
    let span = |of: &[f64]| {
        of.iter().copied().fold(f64::NEG_INFINITY, f64::max)
            - of.iter().copied().fold(f64::INFINITY, f64::min)
    };
    (span(&taking.steps_rad) + span(&taking.phase_offsets_rad)).min(TAU)
}

/// What has been read, and in which order.
fn say_frames(stack: &Stack) -> Result<()> {
    if let (Some(first), Some(last), Some(size)) =
        (stack.sources().first(), stack.sources().last(), stack.geometry())
    {
        let order = match stack.sources().len() {
            1 => first.file.display().to_string(),
            count => format!("{count} files, {} to {}", first.file.display(), last.file.display()),
        };
        let frames = counted(stack.frames(), "frame");
        say!("{frames} of {} x {} pixels in {order}", size.width, size.height);
    }
    if stack.rounded() > 0 {
        say!("{} were rounded to the nearest code", counted(stack.rounded(), "number"));
    }
    if stack.saturated() > 0 {
        say!("{} at --saturation-code or above: clipped", counted(stack.saturated(), "code"));
    }
    Ok(())
}
