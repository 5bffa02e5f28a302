"""What to ask somebody whose place is not sure, and what replies tell.

`asked` is a question as its id says it, `heard` what need not be asked, `questions` chooses by expected entropy, reads
replies, those that are names by `open_questions`. May import index's answers and queries, and what models serves.
"""
