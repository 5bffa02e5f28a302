"""From a query to an answer: localizers, results, evidence and place text."""
