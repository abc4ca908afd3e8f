"""The contracts of Texloom: what a request says, what an answer holds. Imports pydantic only."""
