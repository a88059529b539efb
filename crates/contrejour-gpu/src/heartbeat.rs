//! Whether the device is still there. Its lost callback is the caller's, and what is created on a lost device fails
//! without an error, so it is asked.

use std::future::Future;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::pin::pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use std::task::{Context, Poll, Waker};

use crate::error::DeviceError;

const HERE: u8 = 0;
const ASKED: u8 = 1;
const ANSWERED: u8 = 2;
const LOST: u8 = 3;

/// A small buffer that is asked to be mapped again and again: a lost device refuses that at once. On the web it does so
/// later and a loss stays unknown here: there the caller's lost callback tells.
#[derive(Debug)]
pub(crate) struct Heartbeat {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
}

impl Heartbeat {
    pub fn new(device: &wgpu::Device) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("contrejour heartbeat"),
            size: wgpu::MAP_ALIGNMENT,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, state: Arc::new(AtomicU8::new(HERE)) }
    }

    /// Runs the callbacks of what has arrived, waits for nothing, and asks the device.
    pub fn check(&self, device: &wgpu::Device) -> Result<(), DeviceError> {
        if !self.is(LOST) {
            poll(device, wgpu::PollType::Poll).inspect_err(|_| self.state.store(LOST, Ordering::Release))?;
        }
        // Unmapped only after the answer: another thread that polls may be about to map the buffer.
        if self.is(ANSWERED) {
            let state = if self.can_unmap(device) { HERE } else { LOST };
            self.state.store(state, Ordering::Release);
        }
        if self.is(HERE) {
            self.ask();
        }
        if self.is(LOST) { Err(DeviceError::Lost) } else { Ok(()) }
    }

    /// Unmaps the buffer; false where it has gone with its device.
    fn can_unmap(&self, device: &wgpu::Device) -> bool {
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        self.buffer.unmap();
        let error = pin!(scope.pop()).poll(&mut Context::from_waker(Waker::noop()));
        !matches!(error, Poll::Ready(Some(_)))
    }

    fn ask(&self) {
        self.state.store(ASKED, Ordering::Release);
        let state = Arc::clone(&self.state);
        self.buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
            state.store(if mapped.is_ok() { ANSWERED } else { LOST }, Ordering::Release);
        });
    }

    fn is(&self, state: u8) -> bool {
        self.state.load(Ordering::Acquire) == state
    }
}

/// Polls the device: runs the callbacks of what is done, and waits where it is told to.
///
/// # Errors
///
/// [`DeviceError::Lost`] where the poll finds that the device is lost, for which wgpu 30 panics;
/// [`DeviceError::Unfinished`] where what is waited for does not come.
pub fn poll(device: &wgpu::Device, poll_type: wgpu::PollType) -> Result<wgpu::PollStatus, DeviceError> {
    without_panic(|| device.poll(poll_type))
}

fn without_panic(
    poll: impl FnOnce() -> Result<wgpu::PollStatus, wgpu::PollError>,
) -> Result<wgpu::PollStatus, DeviceError> {
    // wgpu holds no lock and has put its state in order when it panics.
    let polled = catch_unwind(AssertUnwindSafe(poll)).map_err(|_| DeviceError::Lost)?;
    Ok(polled?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_poll_that_panics_is_a_lost_device() {
        let found = without_panic(|| panic!("Error in Device::poll: device is lost"));
        assert!(matches!(found, Err(DeviceError::Lost)));
        let late = without_panic(|| Err(wgpu::PollError::Timeout));
        assert!(matches!(late, Err(DeviceError::Unfinished(wgpu::PollError::Timeout))));
        assert!(matches!(without_panic(|| Ok(wgpu::PollStatus::QueueEmpty)), Ok(wgpu::PollStatus::QueueEmpty)));
    }
}
