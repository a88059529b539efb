//! Silhouettes as JSON.

use serde::Serialize;

use super::found::FoundEdge;

#[derive(Serialize)]
struct Silhouette {
    edges: Vec<(u32, u32, i64)>,
}

/// One object with `edges`: `[a, b, m]`.
pub fn json(edges: &[FoundEdge]) -> Result<String, serde_json::Error> {
    let edges = edges.iter().map(|edge| (edge.low.number, edge.high.number, edge.multiplicity)).collect();
    serde_json::to_string(&Silhouette { edges })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::silhouette::found::tests::edge;

    #[test]
    fn edges_are_triples() {
        let edges = [edge((0, [0.0; 3]), (2, [1.0; 3]), -2), edge((1, [0.0; 3]), (2, [1.0; 3]), 1)];
        assert_eq!(json(&edges).expect("numbers can be written"), r#"{"edges":[[0,2,-2],[1,2,1]]}"#);
        assert_eq!(json(&[]).expect("nothing can be written"), r#"{"edges":[]}"#);
    }
}
