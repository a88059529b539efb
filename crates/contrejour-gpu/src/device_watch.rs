//! Watches the device: error scopes around everything that is created, so that errors reach the caller and not wgpu's
//! handler, and whether it is still there.

use std::fmt;
use std::pin::Pin;
use std::sync::{Mutex, PoisonError};
use std::task::{Context, Poll, Waker};

use crate::error::DeviceError;
use crate::heartbeat::Heartbeat;

/// What scopes catch. What is pushed last is popped first, so that memory is told before what follows from its lack.
const FILTERS: [wgpu::ErrorFilter; 3] =
    [wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal];

/// Scopes that are open on the device for the calling thread.
pub(crate) struct OpenScopes([wgpu::ErrorScopeGuard; 3]);

impl OpenScopes {
    pub fn push(device: &wgpu::Device) -> Self {
        Self(FILTERS.map(|filter| device.push_error_scope(filter)))
    }

    fn pop(self) -> Vec<PendingError> {
        self.0.into_iter().rev().map(|scope| Box::pin(scope.pop()) as _).collect()
    }
}

/// What is known of the device that an object was made on.
#[derive(Debug)]
pub(crate) struct DeviceWatch {
    heartbeat: Heartbeat,
    late: LateErrors,
}

impl DeviceWatch {
    /// Watches the device; `scopes` are open around what was created with the watch, `bytes` together.
    pub fn new(device: &wgpu::Device, scopes: OpenScopes, bytes: u64) -> Result<Self, DeviceError> {
        let mut watch = Self { heartbeat: Heartbeat::new(device), late: LateErrors::default() };
        watch.close(device, scopes, bytes)?;
        Ok(watch)
    }

    /// Runs the callbacks of what is done, waits for nothing, and tells whether the device is there.
    pub fn check(&self, device: &wgpu::Device) -> Result<(), DeviceError> {
        self.heartbeat.check(device)
    }

    /// Errors of earlier scopes that have become known since.
    pub fn late(&mut self) -> Result<(), DeviceError> {
        self.late.arrived()
    }

    /// What went wrong since the scopes were opened: lack of memory, then the loss of the device, which makes all that
    /// follows fail too. What is not known at once, as on the web, is told by [`late`](Self::late). `bytes` is what was
    /// asked for together.
    pub fn close(&mut self, device: &wgpu::Device, scopes: OpenScopes, bytes: u64) -> Result<(), DeviceError> {
        // Inside the scopes, since the heartbeat itself may not have been made.
        let is_here = self.heartbeat.check(device);
        match self.late.add(scopes.pop(), bytes) {
            Err(memory @ DeviceError::OutOfMemory { .. }) => Err(memory),
            created => is_here.and(created),
        }
    }
}

/// The result of a scope that was popped. On the web futures stay on their thread, elsewhere they may change it.
trait ScopeError: Future<Output = Option<wgpu::Error>> + wgpu::WasmNotSend {}

impl<F: Future<Output = Option<wgpu::Error>> + wgpu::WasmNotSend> ScopeError for F {}

type PendingError = Pin<Box<dyn ScopeError>>;

/// Results of scopes that were not known when the scopes were closed.
#[derive(Default)]
struct LateErrors {
    pending: Mutex<Vec<PendingError>>,
    /// Bytes that were asked for when the last scopes were closed.
    bytes: u64,
}

impl LateErrors {
    /// What has arrived since.
    fn arrived(&mut self) -> Result<(), DeviceError> {
        self.add(Vec::new(), self.bytes)
    }

    fn add(&mut self, popped: Vec<PendingError>, bytes: u64) -> Result<(), DeviceError> {
        self.bytes = bytes;
        let pending = self.pending.get_mut().unwrap_or_else(PoisonError::into_inner);
        pending.extend(popped);
        let mut found = None;
        pending.retain_mut(|error| match error.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(Some(error)) => {
                found = Some(error);
                false
            }
            Poll::Ready(None) => false,
            Poll::Pending => true,
        });
        // The last that was popped is the one about memory.
        found.map_or(Ok(()), |error| Err(DeviceError::from_wgpu(&error, bytes)))
    }
}

impl fmt::Debug for LateErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("LateErrors").field("bytes", &self.bytes).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(description: &str) -> wgpu::Error {
        wgpu::Error::Validation { source: "a source".into(), description: description.into() }
    }

    /// As a scope on the web: not known when it is first asked.
    fn known_later(error: Option<wgpu::Error>) -> PendingError {
        let mut answers = [Poll::Ready(error), Poll::Pending].into_iter().collect::<Vec<_>>();
        Box::pin(std::future::poll_fn(move |_| answers.pop().expect("it is asked twice at most")))
    }

    #[test]
    fn an_error_that_comes_late_is_told_once() {
        let mut late = LateErrors::default();
        late.add(vec![known_later(Some(refused("two\n  lines"))), known_later(None)], 7).expect("nothing is known yet");
        let error = late.arrived().expect_err("it has arrived").to_string();
        assert!(error.contains("two lines"), "{error}");
        late.arrived().expect("it was told");
    }

    #[test]
    fn lack_of_memory_is_told_before_what_follows_from_it() {
        let memory = wgpu::Error::OutOfMemory { source: "no room for `edges`".into() };
        let ready = |error| Box::pin(std::future::ready(Some(error))) as PendingError;
        let error = LateErrors::default().add(vec![ready(refused("invalid buffer")), ready(memory)], 1 << 31);
        let text = error.expect_err("there are two").to_string();
        assert!(text.contains("2147483648 bytes") && text.contains("no room for `edges`"), "{text}");
    }
}
