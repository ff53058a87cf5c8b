//! Modbus TCP (MODBUS Messaging on TCP/IP Implementation Guide V1.0b): a register for each of 200 blocks is written, and one
//! is read. A request has room for 123 registers, so that each way takes two.

use std::io::{self, Read, Write as _};
use std::net::{TcpListener, TcpStream};

use super::row::Peer;

const REGISTERS: u16 = 100;
/// Requests each way.
const REQUESTS: u16 = 2;
const WRITE_MULTIPLE: u8 = 16;
const READ_HOLDING: u8 = 3;

/// A master, with a slave on another thread.
pub struct Modbus {
    stream: TcpStream,
    transaction: u16,
    registers: [u16; REGISTERS as usize],
    value: u16,
}

impl Modbus {
    pub fn new() -> io::Result<Modbus> {
        let listener = TcpListener::bind("127.0.0.1:0")?;
        let stream = TcpStream::connect(listener.local_addr()?)?;
        stream.set_nodelay(true)?;
        let (slave, _) = listener.accept()?;
        slave.set_nodelay(true)?;
        std::thread::spawn(move || serve(slave));
        Ok(Modbus { stream, transaction: 0, registers: [0; REGISTERS as usize], value: 0 })
    }

    /// The bytes of all requests.
    pub fn bytes() -> usize {
        usize::from(REQUESTS) * (7 + 6 + 2 * usize::from(REGISTERS) + 7 + 5)
    }

    fn request(&mut self, data: &[u8]) -> io::Result<Vec<u8>> {
        self.transaction = self.transaction.wrapping_add(1);
        self.stream.write_all(&frame(self.transaction, data))?;
        let (transaction, data) = read(&mut self.stream)?;
        if transaction == self.transaction { Ok(data) } else { Err(io::ErrorKind::InvalidData.into()) }
    }
}

impl Peer for Modbus {
    fn call(&mut self) -> io::Result<()> {
        (0..REQUESTS).try_for_each(|_| self.write())?;
        (0..REQUESTS).try_for_each(|_| self.read())
    }
}

impl Modbus {
    fn write(&mut self) -> io::Result<()> {
        self.value = self.value.wrapping_add(1);
        let mut write = vec![WRITE_MULTIPLE, 0, 0, 0, REGISTERS as u8, 2 * REGISTERS as u8];
        (0..REGISTERS).for_each(|k| write.extend(self.value.wrapping_add(k).to_be_bytes()));
        self.request(&write).map(drop)
    }

    fn read(&mut self) -> io::Result<()> {
        let answer = self.request(&[READ_HOLDING, 0, 0, 0, REGISTERS as u8])?;
        for (register, bytes) in self.registers.iter_mut().zip(answer[2..].chunks_exact(2)) {
            *register = u16::from_be_bytes([bytes[0], bytes[1]]);
        }
        if self.registers[0] == self.value { Ok(()) } else { Err(io::ErrorKind::InvalidData.into()) }
    }
}

/// A message: the transaction, protocol 0, how many bytes follow, unit 1, the data.
fn frame(transaction: u16, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(7 + data.len());
    bytes.extend(transaction.to_be_bytes());
    bytes.extend([0, 0]);
    bytes.extend((data.len() as u16 + 1).to_be_bytes());
    bytes.push(1);
    bytes.extend(data);
    bytes
}

fn read(stream: &mut impl Read) -> io::Result<(u16, Vec<u8>)> {
    let mut head = [0; 7];
    stream.read_exact(&mut head)?;
    let mut data = vec![0; usize::from(u16::from_be_bytes([head[4], head[5]])).saturating_sub(1)];
    stream.read_exact(&mut data)?;
    Ok((u16::from_be_bytes([head[0], head[1]]), data))
}

fn serve(mut stream: TcpStream) -> io::Result<()> {
    let mut registers = vec![0; 2 * usize::from(REGISTERS)];
    loop {
        let (transaction, data) = read(&mut stream)?;
        let answer = match data[0] {
            WRITE_MULTIPLE => {
                registers.copy_from_slice(&data[6..]);
                data[..5].to_vec()
            }
            _ => [&[READ_HOLDING, 2 * REGISTERS as u8][..], &registers].concat(),
        };
        stream.write_all(&frame(transaction, &answer))?;
    }
}
